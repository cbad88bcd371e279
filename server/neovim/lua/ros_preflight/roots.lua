-- In whose context a file is shown: `:RosPreflightRoot`, and the code lenses above <launch>.
local client = require('ros_preflight.client')

local M = {}

local function arguments(root)
  local words = {}
  for name, value in pairs(root.args) do
    table.insert(words, name .. ':=' .. value)
  end
  table.sort(words)
  return table.concat(words, ' ')
end

-- A launch in words: its file, and the arguments that it is given.
function M.label(root)
  return vim.trim(vim.fn.fnamemodify(vim.uri_to_fname(root.uri), ':~:.') .. ' ' .. arguments(root))
end

-- Lets the user choose the launch file, and its arguments, in whose context the open file is shown.
function M.select()
  local bufnr = vim.api.nvim_get_current_buf()
  local uri = vim.uri_from_bufnr(bufnr)
  local server = client.clients(bufnr)[1]
  if not server then
    return client.warn('no server is attached to this file')
  end
  local function choose(root)
    client.request(server, 'rosPreflight/selectRoot', { uri = uri, root = root }, bufnr, function(selected, err)
      local message = err or (selected and selected.message)
      if type(message) == 'string' then
        client.warn(message)
      end
      client.refresh_lenses(bufnr)
    end)
  end
  client.request(server, 'rosPreflight/roots', { uri = uri }, bufnr, function(found)
    vim.ui.select(found and found.roots or {}, { prompt = 'As launched by', format_item = M.label }, function(root)
      if not root then
        return
      end
      local prompt = 'Arguments (name:=value ...): '
      vim.ui.input({ prompt = prompt, default = arguments(root) }, function(typed)
        if typed then
          local args = vim.empty_dict()
          for name, value in typed:gmatch('([%w_]+):=(%S*)') do
            args[name] = value
          end
          choose({ uri = root.uri, args = args })
        end
      end)
    end)
  end)
end

-- The places that a code lens counts, in the quickfix list.
function M.show_references(lens, ctx)
  local encoding = vim.lsp.get_client_by_id(ctx.client_id).offset_encoding
  local items = vim.lsp.util.locations_to_items(lens.arguments[3], encoding)
  vim.fn.setqflist({}, ' ', { title = lens.title, items = items })
  vim.cmd('copen')
end

return M
