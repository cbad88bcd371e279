-- `:RosPreflightTree`: what the launch of the current file starts.
local client = require('ros_preflight.client')
local roots = require('ros_preflight.roots')
local view = require('ros_preflight.view')

local M = {}

local FILE_COLOURS = 6
local SEVERITIES = { 'error', 'warning', 'info' } -- as LSP counts

local KIND_COLOURS = { namespace = 'Namespace', param = 'Param', frame = 'Param', remap = 'Remap', section = 'Section' }

local function colour_of(item)
  if item.kind == 'not-taken' then
    return 'LeftOut'
  elseif item.file and (item.kind == 'node' or item.kind == 'include') then
    return 'File' .. (item.file % FILE_COLOURS + 1)
  end
  return KIND_COLOURS[item.kind]
end

-- The findings of an item and, where they are hidden, of what is below it.
local function marks(item, folded)
  local worst, count = item.severity or 4, item.findings
  for _, child in ipairs(folded and item.children or {}) do
    local below, more = marks(child, true)
    worst, count = math.min(worst, below), count + more
  end
  return worst, count
end

local function badge(item, folded)
  local worst, count = marks(item, folded)
  local name = SEVERITIES[worst]
  if count == 0 or not name then
    return nil
  end
  local noun = count == 1 and name or 'problems'
  return { ('  [%d %s]'):format(count, noun), name:gsub('^%l', string.upper) }
end

local function usually_folded(item)
  local closed = item.label == 'Shared parameters' or vim.startswith(item.label, 'Frames')
  return item.kind == 'node' or (item.kind == 'section' and closed)
end

local function add(shown, rows, items, parent, depth, not_run)
  local seen = {}
  for _, item in ipairs(items) do
    local id = ('%s/%s:%s'):format(parent, item.kind, item.name ~= '' and item.name or item.label)
    seen[id] = (seen[id] or 0) + 1
    id = seen[id] == 1 and id or ('%s#%d'):format(id, seen[id])
    local folds = nil
    if #item.children > 0 then
      folds = view.is_folded(shown, id, usually_folded(item))
    end
    local mark = folds == nil and '  ' or (folds and '▸ ' or '▾ ')
    local chunks = { { ('  '):rep(depth) .. mark, 'Quiet' }, { item.label, colour_of(item) } }
    if item.detail ~= '' then
      local between = item.kind == 'param' and ' = ' or '  '
      table.insert(chunks, { between .. item.detail, item.kind ~= 'param' and 'Quiet' or nil })
    end
    local found = badge(item, folds)
    if found then
      table.insert(chunks, found)
    end
    if item.location and item.kind ~= 'param' and item.kind ~= 'remap' then
      local name = vim.fn.fnamemodify(vim.uri_to_fname(item.location.uri), ':t')
      table.insert(chunks, { ('  %s:%d'):format(name, item.location.range.start.line + 1), 'Place' })
    end
    -- What holds for all of them stands above the tree.
    if item.kind == 'node' and item.note ~= '' and item.note ~= not_run then
      table.insert(chunks, { '  ' .. item.note, 'Quiet' })
    end
    table.insert(rows, {
      id = id,
      chunks = chunks,
      place = item.location,
      node = item.kind == 'node' and item.name or nil,
      folds = folds,
    })
    if not folds then
      add(shown, rows, item.children, id, depth + 1, not_run)
    end
  end
end

local KIND = {
  name = 'tree',
  filetype = 'rospreflighttree',
  keys = '<CR> line   <Tab> fold   r refresh   q close',
}

function KIND.ask(shown, server, done)
  client.request(server, 'rosPreflight/tree', { uri = shown.uri }, shown.source, function(tree, err)
    shown.encoding = server.offset_encoding
    done(tree, err or (tree == nil and 'Not a launch file, or unreadable' or nil))
  end)
end

function KIND.rows(shown)
  local tree = shown.data
  local count = ('  %d node%s'):format(tree.nodes, tree.nodes == 1 and '' or 's')
  local rows = {
    {
      id = '#root',
      chunks = { { roots.label(tree.root), 'Title' }, { count, 'Quiet' } },
      place = {
        uri = tree.root.uri,
        range = { start = { line = 0, character = 0 }, ['end'] = { line = 0, character = 0 } },
      },
    },
  }
  local not_run = view.status(shown).notRun
  add(shown, rows, tree.items, '', 0, not_run and not_run.message)
  return rows
end

function M.open(args)
  view.open(KIND, args.mods, {})
end

return M
