-- Drives one headless Neovim: what a user would see and do in the launch file that is open.
-- PREFLIGHT_SCENARIO names what to do; the result, or the error, is written as JSON to PREFLIGHT_RESULT.

local TIMEOUT_MS = 60000

local function wait_for(what, condition)
  local value
  local met = vim.wait(TIMEOUT_MS, function()
    value = condition()
    return value ~= nil and value ~= false
  end, 20)
  if not met then
    local seen = vim.tbl_map(function(d)
      return d.message
    end, vim.diagnostic.get(0))
    error(string.format('gave up waiting for %s; diagnostics: %s', what, vim.fn.json_encode(seen)), 0)
  end
  return value
end

local function diagnostics_with(text)
  return vim.tbl_filter(function(d)
    return d.message:find(text, 1, true) ~= nil
  end, vim.diagnostic.get(0))
end

local function line_with(text)
  for number, line in ipairs(vim.api.nvim_buf_get_lines(0, 0, -1, false)) do
    if line:find(text, 1, true) then
      return number - 1
    end
  end
  error(('no line holds %s:\n%s'):format(text, table.concat(vim.api.nvim_buf_get_lines(0, 0, -1, false), '\n')), 0)
end

local function covered_text(d)
  return vim.api.nvim_buf_get_text(0, d.lnum, d.col, d.end_lnum, d.end_col, {})[1]
end

-- Opens the code action menu at the diagnostic and picks the first entry that names `text`.
local function pick_code_action(d, text)
  local picked
  local offered = {}
  vim.ui.select = function(items, opts, on_choice)
    for index, item in ipairs(items) do
      local title = opts.format_item(item)
      table.insert(offered, title)
      if not picked and title:find(text, 1, true) then
        picked = title
        on_choice(item, index)
      end
    end
  end
  vim.api.nvim_win_set_cursor(0, { d.lnum + 1, d.col })
  vim.lsp.buf.code_action()
  wait_for('a code action that names ' .. text .. '; offered: ' .. vim.fn.json_encode(offered), function()
    return picked
  end)
  return picked
end

-- What is shown for the node element whose start tag holds `text`.
local function hover_on_node(text)
  local line = line_with(text)
  local column = vim.fn.match(vim.fn.getline(line + 1), '<node') + 1
  vim.api.nvim_win_set_cursor(0, { line + 1, column })
  vim.lsp.buf.hover()
  return wait_for('a hover', function()
    for _, window in ipairs(vim.api.nvim_list_wins()) do
      if vim.api.nvim_win_get_config(window).relative ~= '' then
        local lines = vim.api.nvim_buf_get_lines(vim.api.nvim_win_get_buf(window), 0, -1, false)
        vim.api.nvim_win_close(window, true)
        return table.concat(lines, '\n')
      end
    end
  end)
end

local function lines_of(bufnr)
  return vim.api.nvim_buf_get_lines(bufnr, 0, -1, false)
end

local function press(keys)
  vim.api.nvim_feedkeys(vim.api.nvim_replace_termcodes(keys, true, false, true), 'x', false)
end

-- Puts the cursor on the line of the current buffer that holds `text`.
local function on_line_with(text)
  vim.api.nvim_win_set_cursor(0, { line_with(text) + 1, 0 })
end

-- Waits until a buffer holds every one of some texts and none that begin with `!`.
local function wait_for_texts(bufnr, texts)
  local seen
  local ok, err = pcall(wait_for, table.concat(texts, ', '), function()
    seen = table.concat(lines_of(bufnr), '\n')
    for _, text in ipairs(texts) do
      local unwanted = text:sub(1, 1) == '!'
      if (seen:find(unwanted and text:sub(2) or text, 1, true) ~= nil) == unwanted then
        return false
      end
    end
    return true
  end)
  if not ok then
    error(err .. '\n' .. seen, 0)
  end
  return lines_of(bufnr)
end

local function place()
  local cursor = vim.api.nvim_win_get_cursor(0)
  return { vim.fn.expand('%:t'), cursor[1], vim.fn.strpart(vim.fn.getline('.'), cursor[2]) }
end

local function edit(from, to)
  local number = line_with(from)
  local line = vim.fn.getline(number + 1)
  local at = line:find(from, 1, true)
  vim.fn.setline(number + 1, line:sub(1, at - 1) .. to .. line:sub(at + #from))
end

local scenarios = {}

-- The misspelt topic of the listener's remap is reported and mended by the quick fix.
function scenarios.fix()
  local started = vim.loop.hrtime()
  local result = { before = vim.api.nvim_buf_get_lines(0, 0, -1, false) }
  local remap = line_with('to="chater"')
  local diagnostic = wait_for("the listener's diagnostic", function()
    for _, d in ipairs(diagnostics_with('chatter')) do
      if d.lnum == remap then
        return d
      end
    end
  end)
  result.seconds_to_diagnostic = (vim.loop.hrtime() - started) / 1e9
  result.line = diagnostic.lnum
  result.message = diagnostic.message
  result.source = diagnostic.source
  result.severity = vim.diagnostic.severity[diagnostic.severity]
  result.covered = covered_text(diagnostic)
  result.same = #vim.tbl_filter(function(d)
    return d.lnum == diagnostic.lnum and d.message == diagnostic.message
  end, vim.diagnostic.get(0))
  result.hover = hover_on_node('name="listener"')
  result.action = pick_code_action(diagnostic, 'chatter')
  wait_for('the buffer to change', function()
    return not vim.deep_equal(result.before, vim.api.nvim_buf_get_lines(0, 0, -1, false))
  end)
  result.after = vim.api.nvim_buf_get_lines(0, 0, -1, false)
  wait_for('the diagnostic to go away', function()
    return #diagnostics_with('chater') == 0
  end)
  vim.cmd('silent write')
  return result
end

-- Nothing of a workspace that is not trusted is run, and the user is told why.
function scenarios.untrusted()
  local reason = wait_for('a diagnostic that speaks of trust', function()
    return diagnostics_with('not trusted')[1]
  end)
  wait_for('what the sources say of the topic', function()
    return #diagnostics_with('chatter') == 1
  end)
  local hover = hover_on_node('name="listener"')
  return { reason = reason.message, chatter = #diagnostics_with('chatter'), hover = hover }
end

-- The user chooses another context, and the code lens shows it.
function scenarios.root()
  local function titles()
    if #vim.lsp.buf_get_clients(0) > 0 then
      vim.lsp.codelens.refresh()
    end
    return vim.tbl_map(function(lens)
      return lens.command and lens.command.title or ''
    end, vim.lsp.codelens.get(vim.api.nvim_get_current_buf()))
  end
  local before = wait_for('lenses', function()
    local found = titles()
    return table.concat(found, ' '):find('included by', 1, true) and #found == 3 and found
  end)
  local result = { before = before }
  vim.ui.select = function(items, opts, on_choice)
    result.offered = vim.tbl_map(opts.format_item, items)
    on_choice(items[1], 1)
  end
  vim.ui.input = function(opts, on_confirm)
    result.default = opts.default
    on_confirm('speed:=3')
  end
  vim.cmd('RosPreflightRoot')
  result.after = wait_for('a lens with the argument', function()
    local found = titles()
    return table.concat(found, ' '):find('speed:=3', 1, true) and found
  end)
  return result
end

-- A misspelt executable in a launch file of ROS 2: found, completed and mended by the quick fix.
function scenarios.ros2()
  local diagnostic = wait_for('the diagnostic', function()
    return diagnostics_with("'talkr'")[1]
  end)
  local result = { covered = covered_text(diagnostic), filetype = vim.bo.filetype, offered = {} }
  vim.api.nvim_win_set_cursor(0, { diagnostic.lnum + 1, diagnostic.col + 1 })
  local params = vim.lsp.util.make_position_params(0, 'utf-16')
  for _, answer in pairs(vim.lsp.buf_request_sync(0, 'textDocument/completion', params, TIMEOUT_MS) or {}) do
    for _, item in ipairs(answer.result and answer.result.items or {}) do
      table.insert(result.offered, item.label)
    end
  end
  pick_code_action(diagnostic, 'talker')
  wait_for('no diagnostics', function()
    return table.concat(vim.api.nvim_buf_get_lines(0, 0, -1, false)):find('talker', 1, true)
      and #vim.diagnostic.get(0) == 0
  end)
  result.after = vim.api.nvim_buf_get_lines(0, 0, -1, false)
  vim.cmd('RosPreflightTree')
  result.tree = wait_for_texts(0, { 'talker  robot/talker', '!being run', '!ended' })
  return result
end

-- The tree: its lines, folds, jumps, what it says after an edit, and how it closes.
function scenarios.tree()
  local file = vim.api.nvim_get_current_buf()
  vim.cmd('RosPreflightTree')
  local tree = vim.api.nvim_get_current_buf()
  local result = { filetype = vim.bo.filetype, modifiable = vim.bo.modifiable }
  result.lines = wait_for_texts(tree, { 'listener.py  [1 warning]', '!being run', '!ended' })
  local colours = vim.api.nvim_get_namespaces().ros_preflight_view
  local function colour_of(text)
    local marks = vim.api.nvim_buf_get_extmarks(
      tree,
      colours,
      { line_with(text), 0 },
      { line_with(text), -1 },
      { details = true }
    )
    return vim.tbl_map(function(mark)
      return mark[4].hl_group
    end, marks)
  end
  result.colours = { colour_of('inner  '), colour_of('listener  ') }

  on_line_with('talker  preflight_demo')
  press('<Tab>')
  result.unfolded = lines_of(tree)
  on_line_with('rate = ')
  press('<CR>')
  result.param = place()
  vim.cmd('RosPreflightTree')
  result.windows = #vim.api.nvim_list_wins()
  on_line_with('preflight_demo/listener.py')
  press('<CR>')
  result.node = place()
  vim.cmd('RosPreflightTree')
  on_line_with('inner ')
  press('<CR>')
  result.included = place()

  vim.api.nvim_set_current_buf(file)
  edit('name="listener"', 'name="hearer"')
  result.edited = wait_for_texts(tree, { 'hearer  preflight_demo/listener.py  [1 warning]', '!being run' })
  vim.cmd('RosPreflightTree')
  result.cursor = vim.fn.getline('.')
  result.marks = #vim.api.nvim_buf_get_extmarks(tree, colours, 0, -1, {})
  vim.cmd('only')
  press('<CR>')
  result.alone = { #vim.api.nvim_list_wins(), vim.fn.expand('%:t'), vim.wo.number, vim.wo.cursorline }
  vim.cmd('RosPreflightTree')
  press('q')
  result.windows_at_end = #vim.api.nvim_list_wins()
  result.gone = vim.fn.bufexists(tree) == 0
  return result
end

-- The graph: its lines, jumps to launch file and source, and what it says after an edit.
function scenarios.graph()
  local file = vim.api.nvim_get_current_buf()
  vim.cmd('RosPreflightGraph')
  local graph = vim.api.nvim_get_current_buf()
  local result = { filetype = vim.bo.filetype }
  result.lines =
    wait_for_texts(graph, { 'warning: ', 'made in listener.py', 'made in talker.py', '!perhaps', '!being run' })
  on_line_with('/front/listener')
  press('<CR>')
  result.launch = place()
  vim.cmd('RosPreflightGraph')
  press('gs')
  result.source = place()
  vim.cmd('RosPreflightGraph')
  on_line_with('warning: ')
  press('<CR>')
  result.finding = place()

  vim.cmd('RosPreflightGraph!')
  result.builtin = wait_for_texts(graph, { '/rosout' })
  vim.api.nvim_set_current_win(vim.fn.bufwinid(file))
  vim.api.nvim_set_current_buf(file)
  edit('to="chater"', 'to="chatter"')
  vim.cmd('RosPreflightGraph')
  result.edited = wait_for_texts(graph, {
    'from chatter  robot.launch:8  made in listener.py',
    '!chater',
    '!rosout',
    '!perhaps',
    '!being run',
  })
  on_line_with('/front/chatter')
  press('<Tab>')
  result.folded = lines_of(graph)
  return result
end

-- The commands that look after the server.
function scenarios.maintenance()
  local told = {}
  vim.notify = function(message)
    table.insert(told, message)
  end
  local function told_since(count)
    return wait_for('a message', function()
      return told[count + 1]
    end)
  end
  local file = vim.api.nvim_get_current_buf()
  local result = {}
  wait_for('the diagnostic', function()
    return diagnostics_with('chatter')[1]
  end)
  on_line_with('name="talker"')
  vim.cmd('RosPreflightTrace')
  result.one = told_since(0)
  vim.cmd('RosPreflightTrace!')
  result.all = told_since(1)
  on_line_with('<launch>')
  vim.cmd('RosPreflightTrace')
  result.none = told_since(2)
  vim.cmd('RosPreflightTree')
  wait_for_texts(0, { 'listener.py' })
  on_line_with('listener.py')
  vim.cmd('RosPreflightTrace')
  result.tree = told_since(3)
  vim.api.nvim_set_current_win(vim.fn.bufwinid(file))
  wait_for('the end of the runs', function()
    local status = require('ros_preflight.client').status(require('ros_preflight.client').clients(file)[1])
    return status and status.state == 'idle' and diagnostics_with('chatter')[1]
  end)
  vim.cmd('RosPreflightClearCache')
  result.cleared = told_since(4)
  vim.cmd('RosPreflightDoctor')
  wait_for('the page', function()
    return vim.bo.filetype == 'rospreflightdoctor' and vim.fn.line('$') > 1
  end)
  result.doctor = lines_of(0)
  vim.api.nvim_set_current_win(vim.fn.bufwinid(file))

  local client = require('ros_preflight.client')
  local before = client.clients(file)[1].id
  vim.cmd('RosPreflightRestart')
  local after = wait_for('another server', function()
    local now = client.clients(file)[1]
    return now and now.id ~= before and now.id
  end)
  result.old_is_gone = wait_for('the end of the old server', function()
    return vim.lsp.get_client_by_id(before) == nil
  end)
  result.clients = #client.clients()
  edit('to="chater"', 'to="chater2"')
  wait_for('findings of the new server', function()
    return diagnostics_with('chater2')[1]
  end)
  result.status = wait_for('its status', function()
    local status = client.status(vim.lsp.get_client_by_id(after))
    return status and status.state == 'idle' and require('ros_preflight').status(file)
  end)
  return result
end

-- Why two nodes are not connected, by their names and from the cursor.
function scenarios.why()
  local file = vim.api.nvim_get_current_buf()
  local result = {}
  local function links()
    local list = vim.fn.getqflist({ title = true, items = true })
    return #list.items > 0 and list or nil
  end
  wait_for('the diagnostic', function()
    return diagnostics_with('chatter')[1]
  end)
  vim.cmd('RosPreflightWhy /talker /listener')
  local list = wait_for('the links', links)
  result.title = list.title
  result.links = vim.tbl_map(function(item)
    return { item.type, item.lnum, item.text }
  end, list.items)
  vim.cmd('cclose')
  vim.fn.setqflist({})
  vim.api.nvim_set_current_win(vim.fn.bufwinid(file))
  vim.ui.select = function(items, _, on_choice)
    result.choices = items
    on_choice(items[#items])
  end
  on_line_with('name="listener"')
  vim.cmd('RosPreflightWhy')
  result.start = wait_for('the start', links).title
  return result
end

-- The server dies: it is started again once, and what happens then is said.
function scenarios.crash()
  local told = {}
  vim.notify = function(message)
    -- Neovim says of itself how the client quit.
    if message:find('^ros%-preflight: ') then
      table.insert(told, message)
    end
  end
  local client = require('ros_preflight.client')
  local file = vim.api.nvim_get_current_buf()
  -- The process is not among what Neovim tells of a client.
  local function kill()
    local pids = vim.api.nvim_get_proc_children(vim.fn.getpid())
    for _, pid in ipairs(pids) do
      vim.fn.system({ 'kill', '-KILL', tostring(pid) })
    end
  end
  wait_for('the diagnostic', function()
    return diagnostics_with('chatter')[1]
  end)
  local before = client.clients(file)[1].id
  kill()
  wait_for('another server', function()
    local now = client.clients(file)[1]
    return now and now.id ~= before
  end)
  edit('to="chater"', 'to="chater2"')
  wait_for('findings of the new server', function()
    return diagnostics_with('chater2')[1]
  end)
  local result = { clients = #client.clients(), first = told[1] }
  kill()
  result.second = wait_for('what is said of the second time', function()
    return told[2]
  end)
  result.left = wait_for('no server', function()
    return #client.clients() == 0 and 'none'
  end)
  return result
end

-- The running system is watched, and one of its nodes dies.
function scenarios.watch()
  local file = vim.api.nvim_get_current_buf()
  wait_for('the diagnostic', function()
    return diagnostics_with('chatter')[1]
  end)
  vim.cmd('RosPreflightWatch')
  wait_for_texts(0, { 'no differences' })
  local result = { healthy = lines_of(0) }
  vim.fn.system({ 'kill', '-KILL', vim.env.PREFLIGHT_VICTIM })
  wait_for_texts(0, { '/listener', 'since ' })
  result.broken = lines_of(0)
  on_line_with('/listener is')
  vim.api.nvim_feedkeys(vim.api.nvim_replace_termcodes('<CR>', true, false, true), 'xm', false)
  wait_for('the line of the launch file', function()
    return vim.api.nvim_get_current_buf() == file
  end)
  result.line = vim.api.nvim_get_current_line()
  result.marked = #diagnostics_with('running system: /listener')
  vim.cmd('RosPreflightWatch!')
  wait_for('the end of the watch', function()
    return #diagnostics_with('running system: /listener') == 0
  end)
  return result
end

-- A robot description: what is wrong in it as it is typed.
function scenarios.handed_over()
  local result = { filetype = vim.bo.filetype }
  wait_for('the server', function()
    return #require('ros_preflight.client').clients(0) > 0
  end)
  edit('<parent link="base_link"', '<parent link="base_lnk"')
  local found = wait_for('what is wrong in the text that is not saved', function()
    return diagnostics_with('base_lnk')[1]
  end)
  result.covered = covered_text(found)
  return result
end

-- The types of files, and which of them the server is told of.
function scenarios.files()
  local found = {}
  for _, path in ipairs(vim.fn.split(vim.env.PREFLIGHT_FILES, ':')) do
    vim.cmd('edit ' .. path)
    local is_served = require('ros_preflight.client').served(0)
    local name = vim.fn.fnamemodify(path, ':t')
    found[name] = { vim.bo.filetype, is_served, vim.bo.commentstring, vim.b.current_syntax }
  end
  return found
end

-- Which folder a file belongs to, and whether it is trusted.
function scenarios.workspace()
  local workspace = require('ros_preflight.workspace')
  return vim.tbl_map(function(path)
    local root = workspace.root_of(path)
    return { root or '', workspace.is_trusted(root) }
  end, vim.fn.split(vim.env.PREFLIGHT_FILES, ':'))
end

-- The server's program is missing: that is said once.
function scenarios.missing()
  local told = {}
  local notify = vim.notify
  vim.notify = function(message)
    table.insert(told, message)
  end
  package.loaded['ros_preflight.client'].can_start({ 'ros-preflight-that-is-not-there' })
  package.loaded['ros_preflight.client'].can_start({ 'ros-preflight-that-is-not-there' })
  vim.notify = notify
  vim.cmd('RosPreflightTree')
  return {
    told = told,
    messages = vim.fn.execute('messages'),
    tree = lines_of(0),
    clients = #require('ros_preflight.client').clients(),
  }
end

-- Tree and graph where nothing may be run.
function scenarios.views_untrusted()
  local file = vim.api.nvim_get_current_buf()
  vim.cmd('RosPreflightTree')
  local result =
    { tree = wait_for_texts(0, { 'Nodes are not run: the workspace is not trusted', 'talker.py', 'listener.py' }) }
  vim.api.nvim_set_current_win(vim.fn.bufwinid(file))
  vim.cmd('tab RosPreflightGraph')
  result.graph = wait_for_texts(0, { 'Nodes are not run: the workspace is not trusted', 'warning: ' })
  result.tabs = #vim.api.nvim_list_tabpages()
  vim.notify = function(message)
    result.trace = message
  end
  vim.cmd('RosPreflightTrace!')
  wait_for('a message', function()
    return result.trace
  end)
  result.status = wait_for('its status', function()
    local status = require('ros_preflight').status(file)
    return status:find('not run', 1, true) and status
  end)
  return result
end

local ok, result = xpcall(scenarios[vim.env.PREFLIGHT_SCENARIO], function(message)
  return type(message) == 'string' and debug.traceback(message) or vim.inspect(message)
end)
local answer = ok and result or { error = result }
vim.fn.writefile({ vim.fn.json_encode(answer) }, vim.env.PREFLIGHT_RESULT)
vim.cmd('qall!')
