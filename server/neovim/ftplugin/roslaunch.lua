vim.bo.commentstring = '<!-- %s -->'

-- From 0.11 on a server whose program is missing is passed over in silence.
if vim.lsp.is_enabled and vim.lsp.is_enabled('ros_preflight') then
  require('ros_preflight.client').can_start(vim.lsp.config.ros_preflight.cmd)
end
