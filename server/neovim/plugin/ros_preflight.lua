-- Commands, what keeps the code lenses fresh, and colours. Nothing else is loaded before it is used.
if vim.g.loaded_ros_preflight then
  return
end
vim.g.loaded_ros_preflight = true

local function command(name, module, act, options)
  vim.api.nvim_create_user_command(name, function(args)
    require('ros_preflight.' .. module)[act](args)
  end, options)
end

command('RosPreflightRoot', 'roots', 'select', { desc = 'Choose the root launch file and its arguments' })
command('RosPreflightTree', 'tree', 'open', { desc = 'Show the tree of the launch' })
command(
  'RosPreflightGraph',
  'graph',
  'open',
  { bang = true, desc = 'Show the graph; with ! also topics and services of the client library' }
)
command(
  'RosPreflightTrace',
  'maintenance',
  'trace',
  { bang = true, desc = 'Run the node at the cursor again; with ! all nodes' }
)
command(
  'RosPreflightWhy',
  'why',
  'open',
  { nargs = '*', desc = 'Explain the connection of the node at the cursor with another one' }
)
command(
  'RosPreflightWatch',
  'watch',
  'open',
  { bang = true, desc = 'Compare the running system with the launch; with ! stop' }
)
command('RosPreflightDoctor', 'maintenance', 'doctor', { desc = 'Report the environment, packages and sandbox' })
command('RosPreflightClearCache', 'maintenance', 'clear_cache', { desc = 'Delete the results of runs' })
command('RosPreflightRestart', 'maintenance', 'restart', { desc = 'Restart the server' })

-- Above <launch>: who includes the file, how many nodes it starts, and in whose context it is shown.
vim.lsp.commands['rosPreflight.selectRoot'] = function()
  require('ros_preflight.roots').select()
end
vim.lsp.commands['rosPreflight.showReferences'] = function(lens, ctx)
  require('ros_preflight.roots').show_references(lens, ctx)
end

local group = vim.api.nvim_create_augroup('ros_preflight', {})
local events = { 'BufEnter', 'InsertLeave', 'TextChanged' }
if vim.fn.exists('##LspAttach') == 1 then
  table.insert(events, 'LspAttach')
end
vim.api.nvim_create_autocmd(events, {
  group = group,
  callback = function(args)
    -- Without a server that was started there is nothing to load.
    if package.loaded['ros_preflight.client'] then
      require('ros_preflight.client').refresh_lenses(args.buf)
    end
  end,
})

local function define_colours()
  local links = {
    Title = 'Title',
    Quiet = 'Comment',
    Section = 'Statement',
    Namespace = 'Directory',
    Param = 'Identifier',
    Remap = 'Special',
    LeftOut = 'Comment',
    Channel = 'Function',
    Type = 'Type',
    Place = 'Comment',
    Error = 'DiagnosticError',
    Warning = 'DiagnosticWarn',
    Info = 'DiagnosticInfo',
    -- The launch files that nodes come from, in turn; the root file has the first.
    File1 = 'Function',
    File2 = 'Constant',
    File3 = 'String',
    File4 = 'PreProc',
    File5 = 'Type',
    File6 = 'Special',
  }
  for name, target in pairs(links) do
    vim.cmd(('highlight default link RosPreflight%s %s'):format(name, target))
  end
end
vim.api.nvim_create_autocmd('ColorScheme', { group = group, callback = define_colours })
define_colours()
