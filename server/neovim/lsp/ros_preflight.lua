-- The server for `vim.lsp.enable('ros_preflight')`, Neovim 0.11 and newer.
local client = require('ros_preflight.client')

return {
  cmd = require('ros_preflight.options').get().cmd,
  filetypes = client.FILETYPES,
  root_dir = function(bufnr, on_dir)
    local is_served, root = client.served(bufnr)
    if is_served then
      on_dir(root)
    end
  end,
  before_init = function(params, config)
    params.initializationOptions = client.init_options(config.root_dir, config.init_options)
  end,
  handlers = client.handlers,
  on_exit = client.on_exit,
}
