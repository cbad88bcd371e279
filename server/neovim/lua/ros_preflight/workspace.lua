-- Which folder a file belongs to, and whether the user trusts it.
local options = require('ros_preflight.options')

local M = {}

local uv = vim.uv or vim.loop

-- The folder with the first of them is a file's root; of several with the same one the nearest.
local MARKERS = { '.ros-preflight.yaml', '.catkin_tools', '.catkin_workspace', '.git', 'package.xml' }

-- Whether `path` lies in one of the trusted folders, symbolic links followed.
function M.is_trusted(path)
  path = path and uv.fs_realpath(path)
  for _, folder in ipairs(options.get().trusted_folders) do
    folder = uv.fs_realpath(vim.fn.expand(folder))
    if path and folder and vim.startswith(path .. '/', (folder .. '/'):gsub('//$', '/')) then
      return true
    end
  end
  return false
end

-- The folder of the workspace, repository or package of a file; nil outside of any. It never reaches beyond a trusted
-- folder that the file is in, nor, unless it is trusted as a whole, to the user's home.
function M.root_of(file)
  local folder = vim.fn.fnamemodify(file, ':p:h')
  local home = uv.os_homedir()
  local trusted = M.is_trusted(folder)
  local root, rank
  local at, last = folder, nil
  while at ~= last and not (trusted and not M.is_trusted(at)) and (trusted or at ~= home) do
    for index, marker in ipairs(MARKERS) do
      if (rank == nil or index < rank) and uv.fs_stat(at .. '/' .. marker) then
        root, rank = at, index
      end
    end
    at, last = vim.fn.fnamemodify(at, ':h'), at
  end
  if root or not trusted then
    return root
  end
  return (last == home or last == '/') and folder or last
end

return M
