-- `:RosPreflightGraph`: who talks to whom in the launch of the current file.
local client = require('ros_preflight.client')
local view = require('ros_preflight.view')

local M = {}

local SECTIONS = { { 'topic', 'Topics' }, { 'service', 'Services' }, { 'action', 'Actions' } }

-- Who offers and who uses a channel of each kind, and what they are called.
local ENDS = {
  topic = { { role = 'publisher' }, { role = 'subscriber' } },
  service = { { role = 'service', called = 'server' }, { role = 'client' } },
  action = { { role = 'action_server', called = 'server' }, { role = 'action_client', called = 'client' } },
}

local SEVERITY_ORDER = { hint = 0, info = 1, warning = 2, error = 3 }
local SEVERITY_COLOURS = { hint = 'Quiet', info = 'Info', warning = 'Warning', error = 'Error' }

-- A place of the graph, which counts from 1 and in code points, as a location in UTF-32.
local function location(place)
  local position = { line = place.line - 1, character = place.column - 1 }
  return { uri = vim.uri_from_fname(place.file), range = { start = position, ['end'] = position } }
end

local function name_and_line(place)
  return ('%s:%d'):format(vim.fn.fnamemodify(place.file, ':t'), place.line)
end

local function qos(edge)
  local words = {}
  for policy, value in pairs(edge.qos) do
    local text = type(value) == 'table' and vim.inspect(value, { newline = '', indent = '' }) or tostring(value)
    table.insert(words, policy:gsub('_', ' ') .. ' ' .. text)
  end
  table.sort(words)
  return table.concat(words, ', ')
end

local function worst_colour(graph, findings)
  local worst
  for _, index in ipairs(findings) do
    local severity = graph.findings[index + 1].severity
    if not worst or SEVERITY_ORDER[severity] > SEVERITY_ORDER[worst] then
      worst = severity
    end
  end
  return worst and SEVERITY_COLOURS[worst] or nil
end

local function edge_row(graph, channel, edge, called, id)
  local node = graph.nodes[edge.node + 1]
  local launch = edge.places[#edge.places]
  local source = #edge.places > 1 and edge.places[1] or nil
  local chunks = { { ('    %-10s '):format(called), 'Quiet' }, { node.name, 'Namespace' } }
  local function say(text, colour)
    table.insert(chunks, { '  ' .. text, colour })
  end
  if edge.type and #channel.types ~= 1 then
    say(edge.type, 'Type')
  end
  if edge.from then
    say('from ' .. edge.from, 'Remap')
  end
  if edge.uncertain then
    say('uncertain', 'Quiet')
  end
  local policies = qos(edge)
  if policies ~= '' then
    say(policies, 'Quiet')
  end
  if launch then
    say(name_and_line(launch), 'Place')
  end
  if source then
    say('made in ' .. name_and_line(source), 'Place')
  end
  return {
    id = id,
    chunks = chunks,
    place = launch and location(launch),
    source = source and location(source),
    node = node.name,
  }
end

local function channel_rows(shown, rows, graph, channel, edges)
  local id = channel.kind .. ':' .. channel.name
  local folds = view.is_folded(shown, id, false)
  local colour = worst_colour(graph, channel.findings)
  local head = { { folds and '▸ ' or '▾ ', 'Quiet' }, { channel.name, colour or 'Channel' } }
  local function say(text, group)
    table.insert(head, { '  ' .. text, group })
  end
  say(#channel.types > 0 and table.concat(channel.types, ', ') or 'unknown type', 'Type')
  local row = { id = id, chunks = head, folds = folds }
  local below = {}
  for _, side in ipairs(ENDS[channel.kind]) do
    local called = side.called or side.role
    local count = 0
    for _, edge in ipairs(edges) do
      if edge.role == side.role then
        count = count + 1
        local made = edge_row(graph, channel, edge, called, ('%s/%s:%d'):format(id, side.role, count))
        row.place, row.source = row.place or made.place, row.source or made.source
        table.insert(below, made)
      end
    end
    if count == 0 and not channel.external then
      say('no ' .. called, colour or 'Quiet')
    end
  end
  if channel.external then
    say('used outside of the launch', 'Quiet')
  end
  table.insert(rows, row)
  if folds then
    return
  end
  vim.list_extend(rows, below)
  for number, index in ipairs(channel.findings) do
    local finding = graph.findings[index + 1]
    table.insert(rows, {
      id = ('%s/finding:%d'):format(id, number),
      chunks = { { ('    %s: %s'):format(finding.severity, finding.message), SEVERITY_COLOURS[finding.severity] } },
      place = location(finding.place),
    })
  end
end

-- Nodes of which nobody can tell what they do.
local function unknown_rows(rows, graph)
  local found = vim.tbl_filter(function(node)
    return node.source == 'none'
  end, graph.nodes)
  if #found == 0 then
    return
  end
  table.insert(rows, { id = '#unknown', chunks = { { 'Nodes with an unknown interface', 'Section' } } })
  for _, node in ipairs(found) do
    local chunks = { { '  ' .. node.name, 'Namespace' } }
    if node.reason then
      table.insert(chunks, { '  ' .. node.reason, 'Quiet' })
    end
    local place = node.places[1] and location(node.places[1])
    table.insert(rows, { id = 'node:' .. node.name, chunks = chunks, place = place, node = node.name })
  end
end

local KIND = {
  name = 'graph',
  filetype = 'rospreflightgraph',
  keys = '<CR> line in the launch file   gs line in the source   <Tab> fold   r refresh   q close',
}

function KIND.ask(shown, server, done)
  local builtin = shown.settings.builtin
  local params = { uri = shown.uri, builtin = builtin, known = builtin == shown.builtin and shown.digest or nil }
  client.request(server, 'rosPreflight/graph', params, shown.source, function(answer, err)
    shown.encoding = 'utf-32'
    if not answer then
      return done(nil, err or 'Not a launch file, or unreadable')
    end
    shown.digest, shown.builtin = answer.digest, builtin
    done(answer.graph)
  end)
end

function KIND.rows(shown)
  local graph = shown.data
  local edges_of, count_of = {}, {}
  for _, edge in ipairs(graph.edges) do
    edges_of[edge.channel] = edges_of[edge.channel] or {}
    table.insert(edges_of[edge.channel], edge)
  end
  local sections = {}
  for _, section in ipairs(SECTIONS) do
    local kind, title = section[1], section[2]
    local rows = {}
    count_of[kind] = 0
    for index, channel in ipairs(graph.channels) do
      if channel.kind == kind then
        count_of[kind] = count_of[kind] + 1
        channel_rows(shown, rows, graph, channel, edges_of[index - 1] or {})
      end
    end
    if #rows > 0 then
      table.insert(sections, { id = '#' .. kind, chunks = { { title, 'Section' } } })
      vim.list_extend(sections, rows)
    end
  end
  local count = ('  %d nodes, %d topics, %d services, %d actions'):format(
    #graph.nodes,
    count_of.topic,
    count_of.service,
    count_of.action
  )
  local rows = {
    {
      id = '#root',
      chunks = { { graph.title, 'Title' }, { count, 'Quiet' } },
      place = location({ file = graph.root, line = 1, column = 1 }),
    },
  }
  vim.list_extend(rows, sections)
  unknown_rows(rows, graph)
  return rows
end

function M.open(args)
  view.open(KIND, args.mods, { builtin = args.bang })
end

return M
