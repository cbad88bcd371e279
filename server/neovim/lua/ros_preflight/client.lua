-- The language client, in what is the same for all versions of Neovim.
local options = require('ros_preflight.options')
local workspace = require('ros_preflight.workspace')

-- packaging/apply.py writes these lines.
-- luacheck: push no max line length
-- how to install: begin
local HOW_TO_INSTALL =
  "In a clone of the repository run 'python3 -m venv ~/.ros-preflight && ~/.ros-preflight/bin/python -m pip install . && mkdir -p ~/.local/bin && ln -sf ~/.ros-preflight/bin/ros-preflight ~/.local/bin/'"
-- how to install: end
-- luacheck: pop

local M = {}

M.NAME = 'ros_preflight'
-- YAML: ROS 2's launch files and parameter files. XML: robot descriptions and behavior trees.
M.FILETYPES = { 'roslaunch', 'yaml', 'python', 'xml', 'xacro', 'urdf', 'srdf' }

-- Our commands that the server may put into code lenses.
local CLIENT_COMMANDS = { 'rosPreflight.selectRoot', 'rosPreflight.showReferences' }

local HEAD = 200 -- lines that tell a behavior tree from other XML

local status_of = {} -- what each client's server told of itself

-- Whether a Python file is a launch file, whatever it is called; in a launch folder it may become one.
local function makes_launch_description(bufnr, name)
  if name:find('/launch/') ~= nil then
    return true
  end
  for _, line in ipairs(vim.api.nvim_buf_get_lines(bufnr, 0, -1, false)) do
    if line:find('^def%s+generate_launch_description') ~= nil then
      return true
    end
  end
  return false
end

-- Whether an XML file is a robot description or a behavior tree.
local function is_handed_over(bufnr, name)
  if name:find('%.xacro$') or name:find('%.urdf$') or name:find('%.srdf$') then
    return true
  end
  for _, line in ipairs(vim.api.nvim_buf_get_lines(bufnr, 0, HEAD, false)) do
    if line:find('<BehaviorTree%f[^%w]') or line:find('<robot%f[^%w]') then
      return true
    end
  end
  return false
end

-- Whether the server is told of a buffer, and the root of its file. Of Python it gets launch files alone, of XML what
-- launch files hand to nodes; outside of any workspace nobody hands over a file.
function M.served(bufnr)
  local filetype = vim.bo[bufnr].filetype
  if vim.bo[bufnr].buftype ~= '' or not vim.tbl_contains(M.FILETYPES, filetype) then
    return false
  end
  local name = vim.api.nvim_buf_get_name(bufnr)
  local is_launch = filetype == 'roslaunch'
    or (filetype == 'yaml' or filetype == 'python') and name:find('[._]launch%.[^.]+$') ~= nil
    or (filetype == 'python' and makes_launch_description(bufnr, name))
  local root = workspace.root_of(name)
  if is_launch or filetype == 'python' or root == nil then
    return is_launch, root
  end
  return filetype == 'yaml' or is_handed_over(bufnr, name), root
end

-- Whether the server's program is there; says so once where it is not.
function M.can_start(cmd)
  if type(cmd) ~= 'table' or vim.fn.executable(cmd[1]) == 1 then
    return true
  end
  local told = ('ros-preflight: %s is not on PATH. %s'):format(cmd[1], HOW_TO_INSTALL)
  vim.notify_once(told, vim.log.levels.WARN)
  return false
end

function M.init_options(root, given)
  return vim.tbl_extend('force', options.get().init_options, given or {}, {
    workspaceTrusted = workspace.is_trusted(root),
    clientCommands = CLIENT_COMMANDS,
    status = true,
  })
end

-- The clients of a buffer, or all of them.
function M.clients(bufnr)
  if vim.lsp.get_clients then
    return vim.lsp.get_clients({ name = M.NAME, bufnr = bufnr })
  end
  return vim.tbl_filter(function(client)
    return client.name == M.NAME
  end, vim.tbl_values(bufnr and vim.lsp.buf_get_clients(bufnr) or vim.lsp.get_active_clients()))
end

-- Asks the server; `on_result` is called with the result, or nil and why there is none.
function M.request(client, method, params, bufnr, on_result)
  local function handler(err, result)
    on_result(result, err and (err.message or tostring(err)))
  end
  if vim.fn.has('nvim-0.11') == 1 then
    client:request(method, params, handler, bufnr)
  else
    client.request(method, params, handler, bufnr)
  end
end

function M.warn(message)
  vim.notify('ros-preflight: ' .. message, vim.log.levels.WARN)
end

function M.refresh_lenses(bufnr)
  -- Before 0.9 they are those of the current buffer.
  if bufnr == vim.api.nvim_get_current_buf() and #M.clients(bufnr) > 0 then
    vim.lsp.codelens.refresh(vim.fn.has('nvim-0.10') == 1 and { bufnr = bufnr } or nil)
  end
end

-- The names of the files with a syntax error, for people; nil where there are none.
function M.broken(status)
  local names = vim.tbl_map(function(uri)
    return vim.fn.fnamemodify(vim.uri_to_fname(uri), ':t')
  end, status.broken or {})
  return #names > 0 and table.concat(names, ', ') or nil
end

-- What this machine does not have of all that open files need, a line for each kind of thing.
function M.missing(status)
  return status.missing and status.missing.lines or {}
end

-- What a client's server told of itself last: `state`, `done`, `total`, `notRun`, `broken`, `missing`.
function M.status(client)
  return client and status_of[client.id] or nil
end

local function tell(event)
  vim.api.nvim_exec_autocmds('User', { pattern = event, modeline = false })
end

-- How a server ended that nobody told to: it is started again, once in this editor; what crashes twice does so again.
local has_restarted = false
local SIGTERM = 15 -- what Neovim itself sends

function M.on_exit(code, signal)
  if code == 0 and (signal == 0 or signal == SIGTERM) or vim.v.exiting ~= vim.NIL then
    return
  end
  vim.schedule(function()
    if has_restarted then
      return M.warn('the server stopped again; :RosPreflightRestart starts it, and the log says why it stopped')
    end
    has_restarted = true
    M.warn('the server stopped unexpectedly and is started again')
    require('ros_preflight.maintenance').start()
  end)
end

M.handlers = {
  ['rosPreflight/live'] = function(_, told, ctx)
    require('ros_preflight.watch').told(told, ctx.client_id)
  end,
  ['rosPreflight/status'] = function(_, status, ctx)
    status_of[ctx.client_id] = status
    tell('RosPreflightStatus')
  end,
  ['rosPreflight/analysed'] = function()
    M.refresh_lenses(vim.api.nvim_get_current_buf())
    tell('RosPreflightAnalysed')
  end,
}

return M
