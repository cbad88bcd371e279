-- `:RosPreflightWatch`: what of the launch of the current file is not so on the running system.
local client = require('ros_preflight.client')
local roots = require('ros_preflight.roots')
local view = require('ros_preflight.view')

local M = {}

local marks = vim.api.nvim_create_namespace('ros_preflight_watch')
local states = {} -- by client: what its server told last, and since when each difference is there

local function key_of(issue)
  return issue.node .. ' ' .. issue.message
end

-- Shows each difference at the line that should have made what is missing, in the files that are open.
local function mark(issues)
  vim.diagnostic.reset(marks)
  local by_buffer = {}
  for _, issue in ipairs(issues) do
    if issue.location then
      local bufnr = vim.uri_to_bufnr(issue.location.uri)
      by_buffer[bufnr] = by_buffer[bufnr] or {}
      table.insert(by_buffer[bufnr], {
        lnum = issue.location.range.start.line,
        col = 0,
        message = ('running system: %s (since %s)'):format(issue.message, issue.since),
        severity = issue.counts and vim.diagnostic.severity.WARN or vim.diagnostic.severity.INFO,
        source = 'ros-preflight watch',
      })
    end
  end
  for bufnr, found in pairs(by_buffer) do
    if vim.api.nvim_buf_is_loaded(bufnr) then
      vim.diagnostic.set(marks, bufnr, found)
    end
  end
end

-- The server's message about the running system.
function M.told(told, client_id)
  local before = states[client_id] or { since = {} }
  local state = { event = told.event, to = told.to or before.to, reason = told.reason, root = told.root, since = {} }
  state.issues = told.event == 'state' and told.issues or {}
  table.sort(state.issues, function(a, b)
    if a.counts ~= b.counts then
      return a.counts
    end
    return key_of(a) < key_of(b)
  end)
  for _, issue in ipairs(state.issues) do
    issue.since = before.since[key_of(issue)] or os.date('%H:%M:%S')
    state.since[key_of(issue)] = issue.since
  end
  states[client_id] = told.event ~= 'stopped' and state or nil
  mark(state.issues)
  if told.event == 'stopped' and told.reason and told.reason ~= vim.NIL then
    client.warn('the running system is not watched any more: ' .. told.reason)
  end
  vim.api.nvim_exec_autocmds('User', { pattern = 'RosPreflightAnalysed', modeline = false })
end

local KIND = {
  name = 'watch',
  filetype = 'rospreflightwatch',
  keys = '<CR> line   gs source   q close   :RosPreflightWatch! stop',
}

function KIND.ask(shown, server, done)
  shown.encoding = server.offset_encoding
  local state = states[server.id]
  done(state or { event = 'stopped', issues = {} }, not state and 'The running system is not watched' or nil)
end

local function in_words(state)
  if state.event == 'waiting' then
    return 'Waiting for the running system: ' .. (state.reason or '')
  elseif state.event == 'stopped' then
    return 'Not watched'
  end
  local count = #vim.tbl_filter(function(issue)
    return issue.counts
  end, state.issues)
  local what = state.event ~= 'state' and 'looking'
    or (count == 0 and 'no differences' or ('%d difference%s'):format(count, count == 1 and '' or 's'))
  return ('Watching %s: %s'):format(state.to or 'the running system', what)
end

local function known(value)
  return value ~= nil and value ~= vim.NIL
end

function KIND.rows(shown)
  local state = shown.data
  local title = state.root and roots.label(state.root) or 'Running system'
  local rows = { { id = '#root', chunks = { { title, 'Title' }, { '  ' .. in_words(state), 'Quiet' } } } }
  for _, issue in ipairs(state.issues) do
    local chunks = { { issue.message, issue.counts and 'Warning' or 'Info' }, { '  since ' .. issue.since, 'Quiet' } }
    if known(issue.expected) then
      table.insert(chunks, { '  expected: ' .. issue.expected, 'Quiet' })
    end
    if known(issue.actual) then
      table.insert(chunks, { '  seen: ' .. issue.actual, 'Quiet' })
    end
    table.insert(rows, {
      id = key_of(issue),
      chunks = chunks,
      place = known(issue.location) and issue.location or nil,
      source = known(issue.source) and issue.source or nil,
      node = issue.node,
    })
  end
  return rows
end

-- Starts to watch and shows the list; with a bang it stops.
function M.open(args)
  local shown = view.current()
  local bufnr = shown and shown.source or vim.api.nvim_get_current_buf()
  local server = client.clients(bufnr)[1]
  if not server then
    return client.warn('no server is attached to this file')
  end
  local params = { uri = vim.uri_from_bufnr(bufnr), watch = not args.bang }
  client.request(server, 'rosPreflight/watch', params, bufnr, function(answer, err)
    local message = err or (answer and known(answer.message) and answer.message)
    if message then
      client.warn(message)
    end
  end)
  if not args.bang then
    view.open(KIND, args.mods, {})
  end
end

return M
