-- Called by editors.sh in Neovim: tests its language server client with `sikku lsp`, and the syntax file of Vim.
-- Environment: SIKKU, the program; FOLDER, an empty folder; PATTERNS, a list of files, one per line.
local program, folder = vim.env.SIKKU, vim.env.FOLDER

local function check(condition, ...)
  if not condition then error(table.concat(vim.tbl_map(vim.inspect, { ... }), " "), 2) end
end
local function equal(found, expected)
  check(vim.deep_equal(found, expected), found, "instead of", expected)
end
local function await(condition, what)
  check(vim.wait(10000, condition, 5), "waited in vain for", what)
end

local function run()
  local client_id, ended
  local function attach()
    if not client_id then
      client_id = vim.lsp.start_client({
        name = "sikku", cmd = { program, "lsp" }, root_dir = folder,
        on_exit = function(status, signal) ended = { status, signal } end,
      })
    end
    check(vim.lsp.buf_attach_client(0, client_id))
    await(function() return #vim.lsp.buf_get_clients(0) == 1 and vim.lsp.get_client_by_id(client_id).initialized end, "the server")
  end
  local function request(method, parameters)
    local answers, problem = vim.lsp.buf_request_sync(0, method, parameters, 5000)
    check(answers and answers[client_id], method, problem)
    check(not answers[client_id].error, method, answers[client_id].error)
    return answers[client_id].result
  end
  local function document()
    return { textDocument = vim.lsp.util.make_text_document_params() }
  end
  local function cursor(line, column)
    vim.api.nvim_win_set_cursor(0, { line, column })
    return vim.lsp.util.make_position_params(0, "utf-16")
  end
  local function text()
    return vim.api.nvim_buf_get_lines(0, 0, -1, true)
  end
  local function errors()
    return vim.diagnostic.get(0)
  end

  -- Two errors of a pattern are reported, and no longer after their correction.
  local file = folder .. "/mine.lsys"
  vim.fn.writefile({
    "title: 𝄞 mine", "derivation length: 3", "angel factor: 4", "stroke: 0.4mm #f80", "symbols: bud", "axiom: bud α𝄞(F",
    "table a:", "bud-->F[+bud]bud", "table b:", "F --> FF", "schedule: a*2 b",
  }, file)
  vim.cmd("edit " .. file)
  equal(vim.bo.filetype, "sikku")
  attach()
  await(function() return #errors() == 2 end, "two errors")
  local first, second = unpack(errors())
  equal({ first.lnum, first.col, first.end_col, first.severity }, { 2, 0, 5, vim.diagnostic.severity.ERROR })
  check(first.message:find("did you mean 'angle factor'", 1, true), first.message)
  -- Neovim counts bytes: `axiom: bud α𝄞` has 17, and 14 UTF-16 units.
  equal({ second.lnum, second.col, second.end_col }, { 5, 17, 18 })
  vim.api.nvim_buf_set_text(0, 2, 0, 2, 5, { "angle" })
  vim.api.nvim_buf_set_text(0, 5, 10, 5, 19, { "" })
  equal(text()[6], "axiom: bud")
  await(function() return #errors() == 0 end, "no errors")

  -- Help, completion, definitions.
  local help = request("textDocument/hover", cursor(2, 3))
  check(help.contents.value:find("Number of derivation steps", 1, true), help)
  check(help.contents.value:find("| 3 (set) | ", 1, true), help)
  vim.api.nvim_buf_set_lines(0, -1, -1, true, { "turn: " })
  local place = document()
  place.position = { line = 11, character = 6 } -- where no cursor can be but while text is inserted
  local items = request("textDocument/completion", place).items
  equal(vim.tbl_map(function(item) return item.label end, items), { "right", "left" })
  vim.lsp.util.apply_text_edits({ items[2].textEdit }, vim.api.nvim_get_current_buf(), "utf-16")
  equal(text()[12], "turn: left")
  cursor(11, 14)
  vim.lsp.buf.definition()
  await(function() return vim.deep_equal(vim.api.nvim_win_get_cursor(0), { 9, 6 }) end, "the definition of the table b")
  cursor(6, 8)
  vim.lsp.buf.definition()
  await(function() return #vim.fn.getqflist() == 2 or vim.api.nvim_win_get_cursor(0)[1] ~= 6 end, "the definition of bud")
  vim.cmd("silent! cclose")

  -- Renaming, formatting.
  cursor(6, 8)
  vim.lsp.buf.rename("leaf")
  await(function() return text()[6] == "axiom: leaf" end, "the new name")
  equal(text()[5], "symbols: leaf")
  equal(text()[8], "leaf-->F[+leaf]leaf")
  vim.lsp.buf.formatting_sync(nil, 5000)
  equal(text()[8], "leaf --> F[+leaf]leaf")
  vim.wait(200, function() return #errors() > 0 end, 5)
  equal(errors(), {})

  -- Colours and sizes.
  local colours = request("textDocument/documentColor", document())
  equal(#colours, 1)
  equal(colours[1].range, { start = { line = 3, character = 14 }, ["end"] = { line = 3, character = 18 } })
  vim.lsp.codelens.refresh()
  await(function() return #vim.lsp.codelens.get(0) > 0 end, "sizes")
  local title = vim.lsp.codelens.get(0)[1].command.title
  -- Two steps make 3 F, +, [ and ], and 4 leaf; the third doubles F.
  check(title:find("^n = 3: 19 symbols, 6 segments, "), title)

  -- Every pattern: no errors, and the colours of the syntax file.
  local count = { files = 0, units = 0, names = 0 }
  local kinds = { property = "sikkuKey", operator = "sikkuArrow" }
  local sections = { sikkuTable = true, sikkuVariant = true, sikkuSectionName = true, sikkuDraw = true }
  local names = { sikkuName = true, sikkuConstant = true, sikkuSetting = true }
  local symbols = { sikkuSymbol = true, sikkuDraw = true, sikkuTurn = true, sikkuBranch = true, sikkuPen = true }
  for _, pattern in ipairs(vim.fn.readfile(vim.env.PATTERNS)) do
    vim.cmd("edit " .. vim.fn.fnameescape(pattern))
    equal(vim.bo.filetype, "sikku")
    attach()
    local legend = vim.lsp.get_client_by_id(client_id).server_capabilities.semanticTokensProvider.legend.tokenTypes
    local tokens = request("textDocument/semanticTokens/full", document()).data
    for _, one in ipairs(errors()) do
      check(one.severity ~= vim.diagnostic.severity.ERROR, pattern, one)
    end
    -- Every character except blanks belongs to a syntax group; comments are where a scanner finds them.
    local inside = false
    for number, line in ipairs(text()) do
      local slashes = not inside and line:match("^%s*//")
      local at = 1
      while at <= #line do
        local length, comment = 1, inside or slashes
        if not slashes and not inside and line:sub(at, at + 1) == "/*" then
          inside, comment, length = true, true, 2
        elseif not slashes and inside and line:sub(at, at + 1) == "*/" then
          inside, length = false, 2
        end
        for byte = at, at + length - 1 do
          local id = vim.fn.synID(number, byte, 0)
          local group = vim.fn.synIDattr(id, "name")
          local where = { pattern, number, byte, line, group }
          if not line:sub(byte, byte):find("%s") then
            check(id ~= vim.fn.synIDtrans(id), "no colour", where)
            check((group == "sikkuComment") == (comment and true or false), "comment", where)
            count.units = count.units + 1
          end
        end
        at = at + length
      end
    end
    -- Names are where the language server finds them.
    local row, column = 0, 0
    for at = 1, #tokens, 5 do
      if tokens[at] > 0 then column = 0 end
      row, column = row + tokens[at], column + tokens[at + 1]
      local kind, line = legend[tokens[at + 3] + 1], text()[row + 1]
      local byte = vim.str_byteindex(line, column, true) + 1
      local group = vim.fn.synIDattr(vim.fn.synID(row + 1, byte, 0), "name")
      local is_right = kinds[kind] == group or (kind == "property" and group == "sikkuSetting") or (kind == "class" and sections[group])
        or (kind == "function" and symbols[group]) or ((kind == "variable" or kind == "parameter") and names[group])
      check(is_right, "a " .. kind, pattern, row + 1, byte, line, group)
      count.names = count.names + 1
    end
    count.files = count.files + 1
    vim.cmd("bwipeout!")
  end
  check(count.files > 0)

  vim.lsp.stop_client(client_id)
  await(function() return ended end, "the end of the server")
  equal(ended, { 0, 0 })
  io.stdout:write(string.format("Neovim: %d patterns, %d bytes with a colour, %d names where the language server finds them\n",
    count.files, count.units, count.names))
end

local passed, problem = xpcall(run, debug.traceback)
if not passed then io.stderr:write(problem .. "\n") end
vim.cmd(passed and "qall!" or "cquit 1")
