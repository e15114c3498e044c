au BufRead,BufNewFile *.lsys setfiletype sikku
