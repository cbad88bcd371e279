-- ros-preflight in Neovim: what a user's init.lua calls.
local M = {}

-- Starts the server for launch files, on every version. From 0.11 on `vim.g.ros_preflight` and `vim.lsp.enable` do the
-- same.
function M.setup(given)
  vim.g.ros_preflight = given or vim.empty_dict()
  if vim.lsp.enable then
    vim.lsp.enable('ros_preflight')
  else
    require('ros_preflight.attach').follow()
  end
end

-- For a status line: what the server of the buffer does, or why it runs no nodes or not all; empty when there is
-- nothing to say.
function M.status(bufnr)
  local client = require('ros_preflight.client')
  local told = client.status(client.clients(bufnr or vim.api.nvim_get_current_buf())[1])
  if not told then
    return ''
  end
  if told.state ~= 'idle' then
    return told.total > 0 and ('%s %d of %d'):format(told.state, told.done, told.total) or told.state
  end
  local broken = client.broken(told)
  return told.notRun and 'nodes are not run' or broken and 'syntax error in ' .. broken or ''
end

return M
