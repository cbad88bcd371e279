-- What the user sets: `vim.g.ros_preflight`, or what is given to `require('ros_preflight').setup`.
local M = {}

local DEFAULTS = {
  cmd = { 'ros-preflight', 'lsp' },
  trusted_folders = {}, -- those whose nodes may be run, in the sandbox
  init_options = {}, -- more for the server: runNodes, inlayHints, packagePath
  mappings = true, -- before 0.11: the keys that newer versions have for every server
}

function M.get()
  return vim.tbl_extend('force', DEFAULTS, vim.g.ros_preflight or {})
end

return M
