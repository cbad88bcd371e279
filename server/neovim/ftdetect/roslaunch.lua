-- Launch files in XML, and robot descriptions, which are XML. Launch files in YAML and Python keep their types.

local function set(bufnr)
  vim.bo[bufnr].filetype = 'roslaunch'
end

local function is_launch_file(bufnr)
  for _, line in ipairs(vim.api.nvim_buf_get_lines(bufnr, 0, 5, false)) do
    if line:find('<launch[%s/>]') then
      return true
    end
  end
  return false
end

if vim.fn.has('nvim-0.8') == 1 then
  local function by_content(_, bufnr)
    return is_launch_file(bufnr) and 'roslaunch' or nil
  end
  vim.filetype.add({
    extension = { launch = 'roslaunch', xacro = 'xml', urdf = 'xml', srdf = 'xml' },
    pattern = {
      ['.*%.launch%.xml'] = 'roslaunch',
      -- rostest's files, and ROS 2's; others of such names are left alone.
      ['.*%.test'] = by_content,
      ['.*_launch%.xml'] = by_content,
    },
  })
else
  vim.api.nvim_create_autocmd({ 'BufRead', 'BufNewFile' }, {
    group = 'filetypedetect',
    pattern = { '*.launch', '*.launch.xml' },
    callback = function(args)
      set(args.buf)
    end,
  })
  vim.api.nvim_create_autocmd({ 'BufRead', 'BufNewFile' }, {
    group = 'filetypedetect',
    pattern = { '*.xacro', '*.urdf', '*.srdf' },
    callback = function(args)
      vim.bo[args.buf].filetype = 'xml'
    end,
  })
  vim.api.nvim_create_autocmd('BufRead', {
    group = 'filetypedetect',
    pattern = { '*.test', '*_launch.xml' },
    callback = function(args)
      if is_launch_file(args.buf) then
        set(args.buf)
      end
    end,
  })
end
