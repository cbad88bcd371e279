-- Commands that look after the server and what runs of nodes told.
local client = require('ros_preflight.client')
local view = require('ros_preflight.view')

local M = {}

local STOP_WITHIN_MS = 3000 -- then the server is killed

-- Runs the node at the cursor anew, in a launch file or one of our buffers; with a bang all nodes of the launch.
function M.trace(args)
  local server, bufnr, row = view.here()
  if not server then
    return
  end
  local params = { uri = vim.uri_from_bufnr(bufnr) }
  if not args.bang then
    local is_view = bufnr ~= vim.api.nvim_get_current_buf()
    if is_view and not (row and row.node) then
      return client.warn('no node starts on this line')
    end
    params.node = row and row.node
    params.position = not is_view and view.position_in_text(server) or nil
  end
  client.request(server, 'rosPreflight/trace', params, bufnr, function(answer, err)
    local message = err or (answer and answer.message)
    if message then
      client.warn(message)
    elseif answer then
      vim.notify('ros-preflight: running ' .. table.concat(answer.nodes, ', '))
    end
  end)
end

function M.clear_cache()
  local server, bufnr = view.here()
  if not server then
    return
  end
  client.request(server, 'rosPreflight/clearCache', vim.empty_dict(), bufnr, function(cleared, err)
    if not cleared then
      return client.warn(err)
    end
    local results = cleared.entries == 1 and 'result' or 'results'
    vim.notify(
      ('ros-preflight: %d kept %s of runs (%d kB) removed'):format(
        cleared.entries,
        results,
        math.ceil(cleared.bytes / 1000)
      )
    )
  end)
end

-- What launch files and nodes are looked at with, in a scratch buffer.
function M.doctor(args)
  local server, bufnr = view.here()
  if not server then
    return
  end
  client.request(server, 'rosPreflight/doctor', vim.empty_dict(), bufnr, function(answer, err)
    if not answer then
      return client.warn(err)
    end
    local open = vim.fn.bufnr('ros-preflight://doctor')
    if open > 0 then
      vim.api.nvim_buf_delete(open, { force = true })
    end
    local page = view.scratch('doctor', 'rospreflightdoctor', args.mods)
    vim.api.nvim_buf_set_lines(page, 0, -1, false, vim.split(vim.trim(answer.text), '\n'))
    vim.bo[page].modifiable = false
    vim.keymap.set('n', 'q', '<Cmd>bwipeout<CR>', { buffer = page, nowait = true })
  end)
end

-- Starts the server for all files that it is for.
function M.start()
  if vim.lsp.enable then
    vim.lsp.enable(client.NAME)
  else
    require('ros_preflight.attach').attach_all()
  end
end

-- Ends the server, if it still runs, and starts it for all files that it is for.
function M.restart()
  local stopping = client.clients()
  local function stop(force)
    vim.lsp.stop_client(
      vim.tbl_map(function(each)
        return each.id
      end, stopping),
      force
    )
  end
  local ticks = 0
  local timer = (vim.uv or vim.loop).new_timer()
  stop(false)
  timer:start(
    0,
    50,
    vim.schedule_wrap(function()
      if timer:is_closing() then
        return
      end
      stopping = vim.tbl_filter(function(each)
        return vim.lsp.get_client_by_id(each.id) ~= nil
      end, stopping)
      ticks = ticks + 1
      if #stopping == 0 then
        timer:close()
        M.start()
      elseif ticks == STOP_WITHIN_MS / 50 then
        stop(true)
      end
    end)
  )
end

return M
