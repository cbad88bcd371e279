-- Starts the server where there is no `vim.lsp.enable`: Neovim 0.7 to 0.10.
local client = require('ros_preflight.client')
local options = require('ros_preflight.options')

local M = {}

local servers = {} -- the client of each root

local function map_keys(bufnr)
  local function map(keys, action)
    vim.keymap.set('n', keys, action, { buffer = bufnr })
  end
  map('K', vim.lsp.buf.hover)
  map('gd', vim.lsp.buf.definition)
  map('grr', vim.lsp.buf.references)
  map('grn', vim.lsp.buf.rename)
  map('gra', vim.lsp.buf.code_action)
  map('gO', vim.lsp.buf.document_symbol)
end

local function start(root)
  return vim.lsp.start_client({
    name = client.NAME,
    cmd = options.get().cmd,
    root_dir = root,
    workspace_folders = root and { { uri = vim.uri_from_fname(root), name = root } } or nil,
    init_options = client.init_options(root),
    handlers = client.handlers,
    on_exit = client.on_exit,
    on_attach = function(_, bufnr)
      client.refresh_lenses(bufnr)
    end,
  })
end

-- Has the buffer served if it is a file that the server is for.
function M.attach(bufnr)
  local is_served, root = client.served(bufnr)
  if not is_served or not client.can_start(options.get().cmd) then
    return
  end
  local key = root or ''
  if not (servers[key] and vim.lsp.get_client_by_id(servers[key])) then
    servers[key] = start(root)
  end
  if not servers[key] then
    return
  end
  vim.lsp.buf_attach_client(bufnr, servers[key])
  if options.get().mappings then
    map_keys(bufnr)
  end
end

-- Has every buffer served from now on, and those that are loaded.
function M.follow()
  vim.api.nvim_create_autocmd('FileType', {
    group = vim.api.nvim_create_augroup('ros_preflight_attach', {}),
    pattern = client.FILETYPES,
    callback = function(args)
      M.attach(args.buf)
    end,
  })
  M.attach_all()
end

function M.attach_all()
  for _, bufnr in ipairs(vim.api.nvim_list_bufs()) do
    if vim.api.nvim_buf_is_loaded(bufnr) then
      M.attach(bufnr)
    end
  end
end

return M
