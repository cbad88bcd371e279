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
    local seen = vim.tbl_map(function(d) return d.message end, vim.diagnostic.get(0))
    error(string.format('gave up waiting for %s; diagnostics: %s', what, vim.fn.json_encode(seen)), 0)
  end
  return value
end

local function diagnostics_with(text)
  return vim.tbl_filter(function(d) return d.message:find(text, 1, true) ~= nil end, vim.diagnostic.get(0))
end

local function line_with(text)
  for number, line in ipairs(vim.api.nvim_buf_get_lines(0, 0, -1, false)) do
    if line:find(text, 1, true) then
      return number - 1
    end
  end
  error('no line holds ' .. text, 0)
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
  local reason = wait_for('a diagnostic that speaks of trust', function() return diagnostics_with('not trusted')[1] end)
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
  local result = { before = wait_for('lenses', function()
    local found = titles()
    return #found > 0 and found
  end) }
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
  local diagnostic = wait_for('the diagnostic', function() return diagnostics_with("'talkr'")[1] end)
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
  return result
end

local ok, result = xpcall(scenarios[vim.env.PREFLIGHT_SCENARIO], function(message)
  return type(message) == 'string' and debug.traceback(message) or vim.inspect(message)
end)
local answer = ok and result or { error = result }
vim.fn.writefile({ vim.fn.json_encode(answer) }, vim.env.PREFLIGHT_RESULT)
vim.cmd('qall!')
