-- `:RosPreflightWhy`: why two nodes of the launch are connected or not, or why one is started, as a quickfix list.
local client = require('ros_preflight.client')
local view = require('ros_preflight.view')

local M = {}

local MARKS = { ok = 'I', broken = 'E', unknown = 'W' }

-- The links of all chains as items of the quickfix list; a title has no place.
local function items_of(server, chains)
  local items = {}
  for _, chain in ipairs(chains) do
    table.insert(items, { text = chain.title })
    for _, link in ipairs(chain.links) do
      local item = { text = link.text, type = MARKS[link.state] }
      if link.location then
        local made = vim.lsp.util.locations_to_items({ link.location }, server.offset_encoding)[1]
        item = vim.tbl_extend('force', made, item)
      end
      table.insert(items, item)
      for _, fix in ipairs(link.fixes) do
        table.insert(items, { text = 'quick fix: ' .. fix })
      end
    end
  end
  return items
end

local function ask(server, bufnr, params, done)
  client.request(server, 'rosPreflight/why', params, bufnr, function(answer, err)
    local message = err or (answer and answer.message) or (not answer and 'not a launch file, or unreadable')
    if message then
      return client.warn(message)
    end
    done(answer)
  end)
end

local function show(server, answer)
  local title = #answer.chains == 1 and answer.chains[1].title or 'Connections'
  vim.fn.setqflist({}, ' ', { title = title, items = items_of(server, answer.chains) })
  vim.cmd('botright copen')
end

-- The node that is asked for, at the cursor, or the user's choice.
local function first_node(known, given, done)
  local first = given or known.at
  if first then
    return done(first)
  end
  vim.ui.select(known.all, { prompt = 'Explain the connection of which node?' }, function(choice)
    if choice then
      done(choice)
    end
  end)
end

-- The other node; nil stands for the question why the first one is started.
local function second_node(known, first, given, done)
  if given then
    return done(given)
  end
  local start = ('Why is %s started?'):format(first)
  local names = vim.tbl_filter(function(name)
    return name ~= first
  end, known.all)
  table.insert(names, start)
  vim.ui.select(names, { prompt = ('Connection of %s with'):format(first) }, function(choice)
    if choice then
      done(choice ~= start and choice or nil)
    end
  end)
end

-- `:RosPreflightWhy [NODE [NODE [TOPIC]]]`, in a launch file or one of our buffers.
function M.open(args)
  local server, bufnr, row = view.here()
  if not server then
    return
  end
  local params = { uri = vim.uri_from_bufnr(bufnr), nodes = {} }
  if bufnr == vim.api.nvim_get_current_buf() then
    params.position = view.position_in_text(server)
  end
  ask(server, bufnr, params, function(known)
    if #known.all == 0 then
      return client.warn("no node is known of this file's launch")
    end
    first_node(known, args.fargs[1] or (row and row.node), function(first)
      second_node(known, first, args.fargs[2], function(second)
        local wanted = { uri = params.uri, nodes = { first, second }, channel = args.fargs[3] }
        ask(server, bufnr, wanted, function(answer)
          show(server, answer)
        end)
      end)
    end)
  end)
end

return M
