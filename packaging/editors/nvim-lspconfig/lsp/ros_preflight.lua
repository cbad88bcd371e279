---@brief
---
--- https://github.com/OWNER/ros-preflight
---
--- Language server for the launch files of ROS 1 and ROS 2 in XML, YAML and Python, and for parameter files.
---
--- It runs nodes in a sandbox, and only in a workspace that is trusted:
---
--- ```lua
--- vim.lsp.config('ros_preflight', { init_options = { workspaceTrusted = true } })
--- ```
---
--- Launch files of ROS need the file type `roslaunch`:
---
--- ```lua
--- vim.filetype.add({ extension = { launch = 'roslaunch' }, pattern = { ['.*%.launch%.xml'] = 'roslaunch' } })
--- ```

---@type vim.lsp.Config
return {
  cmd = { 'ros-preflight', 'lsp' },
  filetypes = { 'roslaunch' },
  root_markers = { '.ros-preflight.yaml', '.catkin_tools', '.catkin_workspace', '.git', 'package.xml' },
  init_options = { workspaceTrusted = false },
}
