-- Opens a launch file with the configuration of nvim-lspconfig's form alone; writes what the server says to a file.
local file, result = vim.env.LAUNCH_FILE, vim.env.RESULT
vim.filetype.add({ extension = { launch = 'roslaunch' } })
vim.lsp.enable('ros_preflight')
vim.cmd.edit(file)
vim.wait(60000, function()
  return #vim.diagnostic.get(0) > 0
end, 50)
local client = vim.lsp.get_clients({ bufnr = 0 })[1]
local messages = vim.tbl_map(function(each)
  return each.message
end, vim.diagnostic.get(0))
local seen = { root = client and client.root_dir, name = client and client.name, messages = messages }
vim.fn.writefile({ vim.json.encode(seen) }, result)
vim.lsp.stop_client(vim.lsp.get_clients(), true)
vim.cmd('qall!')
