std = "luajit"
globals = { "vim" } -- options and handlers are set in it
max_line_length = 120
