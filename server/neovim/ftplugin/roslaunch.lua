vim.bo.commentstring = '<!-- %s -->'
