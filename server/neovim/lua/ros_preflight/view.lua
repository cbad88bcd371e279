-- Scratch buffers that show what the server knows of a launch: one for each kind, asked for anew when there is news.
--
-- A kind is a table with `name`, `filetype`, `ask(view, server, done)`, which gives the data to `done` or nil and why
-- there is none, and `rows(view)`, which makes lines of `view.data`. A row has `id`, which stays the same while the
-- data changes, `chunks`, pairs of text and colour, and may have `place` (the line of the launch file to go to),
-- `source` (that of the node's source), `node` (a full name), and `folds` (it has rows below that can be hidden).
local client = require('ros_preflight.client')

local M = {}

local STATUS_MS = 100 -- news of the status are gathered for so long: there may be one for each node that is run

local views = {} -- by the name of their kind
local colours = vim.api.nvim_create_namespace('ros_preflight_view')

local function windows_of(bufnr)
  return vim.tbl_filter(function(window)
    return vim.api.nvim_win_get_buf(window) == bufnr
  end, vim.api.nvim_list_wins())
end

-- The client that is asked: the one of the launch file, which may have been started anew.
local function server_of(view)
  return vim.api.nvim_buf_is_valid(view.source) and client.clients(view.source)[1] or nil
end

-- What the server told of itself last.
function M.status(view)
  return client.status(server_of(view)) or {}
end

local function row_at(view, window)
  return view.rows[vim.api.nvim_win_get_cursor(window)[1]]
end

-- A row as text and as what is compared: its text with its colours.
local function written(row)
  local words, look = {}, {}
  for _, chunk in ipairs(row.chunks) do
    -- A line break in what is shown would be refused.
    local text = chunk[1]:gsub('%s*\n%s*', ' ')
    table.insert(words, text)
    vim.list_extend(look, { text, chunk[2] or '' })
  end
  return words, table.concat(look, '\0')
end

local function colour(view, number, row, words)
  local column = 0
  for index, text in ipairs(words) do
    local group = row.chunks[index][2]
    if group and text ~= '' then
      vim.api.nvim_buf_set_extmark(view.bufnr, colours, number - 1, column, {
        end_col = column + #text,
        hl_group = 'RosPreflight' .. group,
      })
    end
    column = column + #text
  end
end

-- Shows these rows; only those between the first and the last that changed are written, for there may be thousands, and
-- news with every node that is run.
local function set_rows(view, rows)
  local old = view.rows
  local words, line_of = {}, {}
  for number, row in ipairs(rows) do
    words[number], row.look = written(row)
    line_of[row.id] = line_of[row.id] or number
  end
  local same, same_at_end = 0, 0
  local least = math.min(#old, #rows)
  while same < least and old[same + 1].look == rows[same + 1].look do
    same = same + 1
  end
  while same_at_end < least - same and old[#old - same_at_end].look == rows[#rows - same_at_end].look do
    same_at_end = same_at_end + 1
  end
  local cursors = {}
  for _, window in ipairs(windows_of(view.bufnr)) do
    local row = row_at(view, window)
    cursors[window] = { row and row.id, vim.api.nvim_win_get_cursor(window) }
  end
  view.rows = rows
  if same == #rows and same == #old then
    return
  end

  local lines = {}
  for number = same + 1, #rows - same_at_end do
    table.insert(lines, table.concat(words[number]))
  end
  -- An empty buffer has a line all the same.
  local stop = #old == 0 and -1 or #old - same_at_end
  -- Marks would outlive their lines.
  vim.api.nvim_buf_clear_namespace(view.bufnr, colours, same, stop)
  vim.bo[view.bufnr].modifiable = true
  vim.api.nvim_buf_set_lines(view.bufnr, same, stop, false, lines)
  vim.bo[view.bufnr].modifiable = false
  for number = same + 1, #rows - same_at_end do
    colour(view, number, rows[number], words[number])
  end
  for window, before in pairs(cursors) do
    local id, cursor = before[1], before[2]
    vim.api.nvim_win_set_cursor(window, { line_of[id] or math.min(cursor[1], #rows), cursor[2] })
  end
end

-- What is true of all that is shown: that it is not the newest, or that nodes are not run.
local function header(view)
  local rows = { { id = '#keys', chunks = { { view.kind.keys, 'Quiet' } } } }
  local function say(text, highlight)
    table.insert(rows, { id = '#' .. #rows, chunks = { { text, highlight } } })
  end
  if view.problem then
    say(view.problem, 'Warning')
  end
  local status = M.status(view)
  if status.state == 'tracing' then
    say(('Running nodes: %d of %d'):format(status.done, status.total), 'Info')
  elseif status.notRun then
    say('Nodes are not run: ' .. status.notRun.message, 'Warning')
  elseif client.broken(status) then
    say(('Syntax error in %s: nodes that it affects are not run'):format(client.broken(status)), 'Warning')
  end
  for _, line in ipairs(client.missing(status)) do
    say('Missing on this machine: ' .. line, 'Quiet')
  end
  return rows
end

local function draw(view)
  if not vim.api.nvim_buf_is_valid(view.bufnr) then
    return
  end
  local rows = header(view)
  if view.data then
    vim.list_extend(rows, view.kind.rows(view))
  end
  set_rows(view, rows)
end

-- Asks for newer data: once at a time, and again when news came meanwhile.
local function refresh(view)
  if view.asking then
    view.ask_again = true
    return
  end
  local server = server_of(view)
  if not server then
    local file = vim.api.nvim_buf_is_valid(view.source) and vim.api.nvim_buf_get_name(view.source) or 'the file'
    view.problem = ('No server is attached to %s (yet)'):format(vim.fn.fnamemodify(file, ':~:.'))
    return draw(view)
  end
  view.asking = true
  local source = view.source
  view.kind.ask(view, server, function(data, problem)
    view.asking = false
    if source == view.source then
      view.problem = problem
      view.data = data or view.data
      view.asked = view.asked + 1
      draw(view)
    end
    if view.ask_again then
      view.ask_again = false
      refresh(view)
    end
  end)
end

-- A window for a file: that of the launch file, or another one that shows a file.
local function window_for_files(view)
  local found
  for _, window in ipairs(vim.api.nvim_tabpage_list_wins(0)) do
    local bufnr = vim.api.nvim_win_get_buf(window)
    local is_floating = vim.api.nvim_win_get_config(window).relative ~= ''
    if bufnr == view.source then
      return window
    elseif not is_floating and vim.bo[bufnr].buftype == '' then
      found = found or window
    end
  end
  return found
end

local function go(view, location, encoding)
  if not location then
    return vim.api.nvim_echo({ { 'No line of a file created this', 'WarningMsg' } }, false, {})
  end
  local window = window_for_files(view)
  if window then
    vim.api.nvim_set_current_win(window)
  else
    vim.cmd('leftabove vnew')
    vim.bo.bufhidden = 'wipe'
  end
  if vim.lsp.util.show_document then
    vim.lsp.util.show_document(location, encoding, { focus = true })
  else
    vim.lsp.util.jump_to_location(location, encoding)
  end
end

-- The row at the cursor of one of our buffers, if the current one is such.
function M.current()
  for _, view in pairs(views) do
    if view.bufnr == vim.api.nvim_get_current_buf() then
      return view, row_at(view, 0)
    end
  end
end

-- The server of the current file or, in one of our buffers, of what it shows; with the row at the cursor.
function M.here()
  local shown, row = M.current()
  local bufnr = shown and shown.source or vim.api.nvim_get_current_buf()
  local server = vim.api.nvim_buf_is_valid(bufnr) and client.clients(bufnr)[1] or nil
  if not server then
    client.warn('no server is attached to this file')
  end
  return server, bufnr, row
end

-- The cursor's position; that of the first character where it stands in front of the text of its line.
function M.position_in_text(server)
  local position = vim.lsp.util.make_position_params(0, server.offset_encoding).position
  position.character = math.max(position.character, #vim.fn.getline('.'):match('^%s*'))
  return position
end

local function map_keys(view)
  local function map(keys, action)
    vim.keymap.set('n', keys, function()
      local row = row_at(view, 0)
      if row then
        action(row)
      end
    end, { buffer = view.bufnr, nowait = true })
  end
  local function to_line(row)
    go(view, row.place, view.encoding)
  end
  map('<CR>', to_line)
  map('<2-LeftMouse>', to_line)
  map('gs', function(row)
    go(view, row.source, view.encoding)
  end)
  map('<Tab>', function(row)
    if row.folds ~= nil then
      view.folded[row.id] = not row.folds
      draw(view)
    end
  end)
  map('r', function()
    refresh(view)
  end)
  map('q', function()
    vim.cmd('bwipeout')
  end)
end

-- Whether the rows below one are hidden, which they are at first if `usually`.
function M.is_folded(view, id, usually)
  local chosen = view.folded[id]
  if chosen == nil then
    return usually
  end
  return chosen
end

local function follow_news()
  vim.api.nvim_create_autocmd('User', {
    group = vim.api.nvim_create_augroup('ros_preflight_views', {}),
    pattern = { 'RosPreflightAnalysed', 'RosPreflightStatus' },
    callback = function(args)
      for _, view in pairs(views) do
        if args.match == 'RosPreflightAnalysed' then
          refresh(view)
        elseif not view.draws then
          view.draws = true
          vim.defer_fn(function()
            view.draws = false
            draw(view)
          end, STATUS_MS)
        end
      end
    end,
  })
end

-- A window with a scratch buffer of this name and type.
function M.scratch(name, filetype, mods)
  vim.cmd((mods ~= '' and mods or 'botright vertical') .. ' new')
  local bufnr = vim.api.nvim_get_current_buf()
  vim.bo[bufnr].buftype = 'nofile'
  vim.bo[bufnr].bufhidden = 'wipe'
  vim.bo[bufnr].swapfile = false
  vim.bo[bufnr].buflisted = false
  vim.api.nvim_buf_set_name(bufnr, 'ros-preflight://' .. name)
  vim.bo[bufnr].filetype = filetype
  vim.opt_local.wrap = false
  vim.opt_local.number = false
  vim.opt_local.relativenumber = false
  vim.opt_local.spell = false
  vim.opt_local.list = false
  vim.opt_local.cursorline = true
  return bufnr
end

-- Shows the launch of the current file, in the window of its kind or a new one made as `mods` say.
function M.open(kind, mods, settings)
  local at, view = M.current(), views[kind.name]
  local source = at and at.source or vim.api.nvim_get_current_buf()
  if view and #client.clients(source) == 0 and vim.api.nvim_buf_is_valid(view.source) then
    source = view.source -- the current file is none of ours: a node's source, say
  end
  if not view or view.source ~= source then
    local bufnr = view and view.bufnr
    view = { kind = kind, source = source, rows = {}, folded = {}, encoding = 'utf-16', asked = 0, bufnr = bufnr }
  end
  view.settings = settings
  view.uri = vim.uri_from_bufnr(source)
  views[kind.name] = view
  local window = view.bufnr and windows_of(view.bufnr)[1]
  if window then
    vim.api.nvim_set_current_win(window)
  else
    view.bufnr = M.scratch(kind.name, kind.filetype, mods)
    vim.api.nvim_create_autocmd('BufWipeout', {
      buffer = view.bufnr,
      callback = function(args)
        if views[kind.name] and views[kind.name].bufnr == args.buf then
          views[kind.name] = nil
        end
      end,
    })
  end
  map_keys(view)
  follow_news()
  draw(view)
  refresh(view)
end

return M
