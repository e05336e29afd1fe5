-- Draws and measures meshes in documents of Pandoc (2.17 and later) and Quarto:  pandoc --lua-filter meshfolio.lua scan.md -o scan.html
--
-- ```{.meshfolio #fig-h caption="Mean curvature"}     Lines are commands of meshfolio, with quotes as in a shell, but run by no shell.
-- render scan.ply --field h-cotan                     Each yields a figure, a table, or a file for later blocks in <document>_files.
-- ```
-- @fig-h shows the `inspect scan.ply boundary_loops`{.meshfolio} holes; the volume is `inspect scan.ply volume`{.meshfolio digits=3}.
--
-- A command runs again only if it, the contents of its inputs, or the program changed (SHA-1; Pandoc computes no SHA-256).
local COMMANDS = "render inspect curvature spectrum smooth noise compare sample show"
local WRITES = "o output out csv ply plot glb vectors html junit"          -- options that name outputs
local FILTER_KEYS = "meshes data errors allow-outside echo digits size"    -- of the metadata; other keys are options of render
local MOST_ROWS, DIGITS, LINE = 40, 4, 72   -- of a table, of a number, unless rows= and digits= are given; characters of a line
local stringify, join, sha1, List = pandoc.utils.stringify, pandoc.path.join, pandoc.utils.sha1, pandoc.List
local program = os.getenv("MESHFOLIO") or "meshfolio"   -- never from the document, which could name any program
local document = quarto and quarto.doc.input_file or PANDOC_STATE.input_files[1] or "document.md"
local folder, is_latex = pandoc.path.directory(document), FORMAT == "latex" or FORMAT == "beamer"
local files = pandoc.path.normalize(join{folder, pandoc.path.split_extension(pandoc.path.filename(document)) .. "_files"})
local settings, render_options, meshes, folders, sources, numbers = {}, {}, {}, {".", ".."}, {}, {}
local digests, checked, line_of_block, identity = {}, {}, 0, nil

local function has(words, word) return (" " .. words .. " "):find(" " .. word .. " ", 1, true) ~= nil end
local function option_of(element, name) return element.attributes[name] or settings[name] end
local function lines_before(text, at) return select(2, text:sub(1, at - 1):gsub("\n", "")) end
local function refuse(message) error({message = message}, 0) end

local function contents(path)
  local file = io.open(path, "rb")
  local text = file and file:read("a")   -- nil for a folder
  if file then file:close() end
  return text
end

--- Splits a text into commands {words…, text=, line= from 0}, with the quotes and escapes of a POSIX shell and none of its other powers.
local function commands_of(text)
  local commands, command, word, at = {}, nil, nil, 1
  text = text .. "\n"
  while at <= #text do
    local char, last = text:sub(at, at), at
    line_of_block = lines_before(text, at)
    if char:match("%s") then
      if word then command:insert(word) end
      if char == "\n" and command then command.text = text:sub(command.first, at - 1) end
      command, word = char ~= "\n" and command or nil, nil
    elseif text:match("^\\\n", at) then
      last = at + 1
    elseif char == "#" and not command then
      last = text:find("\n", at, true) - 1
    elseif char:match("[;|&`]") or char:match("[<>]") and not word then
      refuse("'" .. char .. "' means nothing without a shell; write one command a line, or quote a name")
    else
      if not command then
        command = List{}
        command.first, command.line, commands[#commands + 1] = at, line_of_block, command
      end
      if char == "\\" then
        last, char = at + 1, text:sub(at + 1, at + 1)
      elseif char == "'" or char == '"' then
        repeat last = text:find(char, last + 1, true) or refuse("a quote is not closed; close it")
        until char == "'" or #text:sub(at, last - 1):match("\\*$") % 2 == 0
        local inner = text:sub(at + 1, last - 1)
        char = char == "'" and inner or inner:gsub("\\\n", ""):gsub('\\([\\"$`])', "%1")
      end
      word = (word or "") .. char
    end
    at = last + 1
  end
  return commands
end

--- Returns a path without symbolic links; the path itself where the system has no such readlink.
local function real(path)
  local ok, out = pcall(pandoc.pipe, "readlink", {"-m", "--", path}, "")
  return ok and out:gsub("/?\n$", "/") or path .. "/"
end

local function leaves(name)
  return not settings.anywhere and (pandoc.path.is_absolute(name) or ("/" .. name:gsub("\\", "/") .. "/"):find("/../", 1, true) ~= nil)
end

--- Returns the path of a name in a folder. Refuses a name that leaves it, also by a link, unless the metadata allows that.
local function inside(root, name)
  local path = pandoc.path.normalize(join{root, name})
  if leaves(name) or not (checked[path] or settings.anywhere or real(path):find(real(root), 1, true) == 1) then
    refuse("'" .. name .. "' leads out of the folders of the document; use files in there, or set allow-outside in the metadata")
  end
  checked[path] = true
  return path
end

--- Returns the digest of a file, or of the results in the folder of a report; nil if there is none.
local function digest(path)
  local bytes = not digests[path] and (contents(path) or contents(join{path, "results.json"}))
  digests[path] = bytes and sha1(bytes) or digests[path]
  return digests[path]
end

--- Returns the path of an input, the first of its names in the first folder that has it, or nothing.
local function input(name)
  for _, known in ipairs(meshes[name] or {name}) do
    for _, root in ipairs(folders) do
      if leaves(known) or digest(join{root, known}) then return inside(root, known) end
    end
  end
end

--- Returns the words for the program, in which inputs are paths; the digests of inputs; the outputs; the set of options.
local function prepare(command)
  local words, inputs, outputs, given = List{command[1]}, List{}, List{}, {}
  if not has(COMMANDS, command[1]) then refuse("'" .. command[1] .. "' cannot be run here; the commands are " .. COMMANDS:gsub(" ", ", ")) end
  for i = 2, #command do
    local word, option, value = command[i], command[i]:match("^%-%-([%w-]+)=(.*)$")
    if not option then option, value = command[i - 1]:match("^%-%-?(%a[%w-]*)$") or "", word end
    given[option], given[word:match("^%-%-?([%w-]+)") or ""] = true, true
    if word:match("^%-%a.") then
      refuse("'" .. word .. "' is not an option; write a blank behind '" .. word:sub(1, 2) .. "'")
    elseif has(WRITES, option) and value ~= "-" then
      value = inside(".", value)
      outputs:insert(value)
    elseif option ~= "title" then
      local name, column = value, ""
      if option == "values" then name, column = value:match("^(.-)(:?[^:]*)$") end
      local path = input(name)
      if path then inputs:insert(digest(path)) end
      value = path and path .. column or value
    end
    words:insert(word:match("^%-%-[%w-]+=") and "--" .. option .. "=" .. value or value)
  end
  return words, inputs, outputs, given
end

--- Runs the program. Returns true and what it printed, or false and the reason.
local function call(words)
  local environment, ok, printed = pandoc.system.environment(), nil, nil
  environment.MESHFOLIO_ERRORS = "stdout"   -- Pandoc gives no standard error
  pandoc.system.with_environment(environment, function() ok, printed = pcall(pandoc.pipe, program, words, "") end)
  return ok, ok and printed or type(printed) == "table" and printed.output:gsub("^meshfolio: ", ""):gsub("\n$", "") or tostring(printed)
end

local function make_folder(path)
  if pandoc.system.make_directory then pandoc.system.make_directory(path, true) else pandoc.pipe("mkdir", {"-p", "--", path}, "") end
end

--- Runs a command in the folder of the files, unless its result is in the cache. Returns what it printed, and the pictures that it made.
local function run_here(command, stem)
  local words, inputs, outputs, given = prepare(command)
  local draws = command[1] == "render" and not given.out
  for _, option in ipairs(draws and render_options or {}) do
    if not given[option.name] then words:insert(option.word) end
  end
  local key = identity .. table.concat(inputs, " ") .. "\0" .. table.concat(words, "\0")
  if draws and not (given.o or given.output) then
    outputs:insert(inside(".", stem:gsub("[^%w_-]", "-") .. "-" .. sha1(key):sub(1, 8) .. (is_latex and ".pdf" or ".png")))
    words:insert("--output=" .. outputs[#outputs])
  end
  local record = inside(".", join{"cache", sha1(key .. "\0" .. table.concat(outputs, "\0"))})
  local function state() return table.concat(outputs:map(function(path) return digest(path) or "none" end), " ") .. "\n" end
  local kept, now = contents(record) or "", state()
  local ok, printed = true, kept:sub(#now + 1)
  if kept:sub(1, #now) ~= now then
    for _, path in ipairs{record, table.unpack(outputs)} do make_folder(pandoc.path.directory(path)) end
    ok, printed = call(words)
    digests = {}
    local file = io.open(ok and record or refuse(printed), "wb")
    file:write(state(), printed)
    file:close()
  end
  local named = printed:match("([^\n]+)\n$") or ""   -- a picture that `show` names, or the sheet of `render --out`
  if not outputs:includes(named) and contents(named) then outputs = List{named} end
  return outputs:includes(named) and "" or printed, outputs:filter(function(path) return path:match("%.[ps][nvd][gf]$") end)
end

local function run(command, stem)
  local ok, printed, pictures
  line_of_block = command.line
  if not identity then
    ok, identity = call{"version", "--build"}
    if not ok then refuse("the program '" .. program .. "' does not run; install it, or name it in the variable MESHFOLIO") end
    make_folder(files)
    if real(files) ~= real(folder) .. pandoc.path.filename(files) .. "/" then refuse("'" .. files .. "' is a link; remove it") end
  end
  pandoc.system.with_working_directory(files, function() ok, printed, pictures = pcall(run_here, command, stem) end)
  if not ok then error(printed, 0) end
  return printed, pictures:map(function(path) return pandoc.path.normalize(join{files, path}) end)
end

--- Returns an element whose numbers are rounded for people, whole ones only if digits are given.
local function rounded(content, element)
  local digits = tonumber(option_of(element, "digits"))
  return pandoc.walk_block(content, {Str = function(str)
    local open, number, close = str.text:match("^(%(?)([-+]?[%d.]+[eE]?[-+]?%d*)([,;)]*)$")
    if not tonumber(number) or not (digits or number:find("[.eE]")) then return nil end
    local shown = string.format("%." .. (digits or DIGITS) .. "g", number)
    local mantissa, power = shown:match("^(.*)e(.*)$")
    power = math.tointeger(power)
    if not power or power > 0 and power < 7 then return pandoc.Str(open .. (power and ("%.0f"):format(shown) or shown) .. close) end
    return {pandoc.Str(open), pandoc.Math("InlineMath", mantissa .. "\\times10^{" .. power .. "}"), pandoc.Str(close)}
  end})
end

--- Returns CSV as a table. Columns of numbers are aligned to the right, long lines wrapped.
local function table_of(csv, has_head, element)
  local simple, widths, total = pandoc.utils.to_simple_table(rounded(pandoc.read(csv, "csv").blocks[1], element)), {}, 0
  local all, most = #simple.rows, tonumber(element.attributes.rows)
  simple.rows = List{table.unpack(simple.rows, 1, math.min(all, most or MOST_ROWS))}
  for j, title in ipairs(simple.header) do
    local name, texts = stringify(title), simple.rows:map(function(row) return stringify(row[j]) end)
    local is_text = texts:find_if(function(text) return not text:match("^[%d.,()%s+-]*$") and not text:match("times10") end)
    simple.aligns[j], widths[j] = is_text and "AlignLeft" or "AlignRight", math.max(#name, table.unpack(texts:map(function(text) return #text end))) + 2
    simple.header[j], total = {pandoc.Plain((name:gsub("_", " ")))}, total + widths[j]
  end
  for j, width in ipairs(widths) do simple.widths[j] = total > LINE and width / total or 0 end
  if not has_head then simple.header = {} end
  return {pandoc.utils.from_simple_table(simple), all > (most or MOST_ROWS) and not most and pandoc.Para("… of " .. all .. " rows") or nil}
end

--- Returns what a command printed as blocks: CSV, and columns parted by two blanks, as tables; other lines as paragraphs.
local function blocks_of(text, element)
  if text:match("^[^\n]*,[^ \n]*\n") then return table_of(text, true, element) end
  local blocks, rows, commas = List{}, "", ""
  for line in (text .. "\n"):gmatch("(.-)\n") do
    local cells, gaps = line:gsub('"', '""'):gsub("%s%s+", '","')
    if gaps > 0 then
      rows, commas = rows .. '"' .. cells:gsub("_", " ") .. '"\n', gaps > #commas and (","):rep(gaps) or commas
    else
      if rows ~= "" then blocks:extend(table_of(commas .. "\n" .. rows, false, element)) end
      if line ~= "" then blocks:insert(rounded(pandoc.Para(line), element)) end
      rows = ""
    end
  end
  return blocks
end

--- Returns an image, named from the folder of the document that is written.
local function image_of(path, caption, given)
  local written, shown = pandoc.path.directory(PANDOC_STATE.output_file or "x"), path
  if written ~= "." and not is_latex then
    shown = pandoc.path.make_relative(path, written, true)
    pandoc.mediabag.insert(shown, nil, contents(path))   -- for writers that embed pictures
  end
  shown = shown:gsub("[%%#?]", function(char) return ("%%%02X"):format(char:byte()) end)
  return pandoc.Image(caption, shown, "", {"", {}, {width = given.width, height = given.height, alt = given.alt}})
end

--- Returns the figure of a block: an image, or several above one caption.
local function figure_of(paths, block, caption)
  local id, single, images = block.identifier, #paths == 1, List{}
  local alt = single and #caption > 0 and caption or block.attributes.alt or block.text
  for _, path in ipairs(paths) do images:extend{image_of(path, alt, block.attributes), not single and pandoc.Space() or nil} end
  if #caption == 0 then return pandoc.Div(pandoc.Para(images), {id}) end
  if pandoc.Figure then return pandoc.Figure({pandoc.Plain(images)}, {long = {pandoc.Plain(caption)}}, {id}) end
  if single then images[1].title, images[1].identifier = "fig:", id return pandoc.Para(images) end   -- a figure of Pandoc 2
  if is_latex then caption:insert(1, pandoc.RawInline("latex", "\\refstepcounter{figure}\\label{" .. id .. "}Figure~\\thefigure: ")) end
  return pandoc.Div({pandoc.Para(images), pandoc.Para(caption)}, {id, {"figure"}})
end

--- Returns the inlines that one command in running text yields.
local function inlines_of(code)
  local commands = commands_of(code.text)
  local printed = #commands == 1 and run(commands[1], "render") or refuse("write one command here")
  return rounded(pandoc.Plain((printed:gsub("%s+$", ""))), code).content
end

--- Returns the blocks that the commands of a block yield.
local function blocks_of_commands(block)
  local id, blocks, pictures, echo = block.identifier, List{}, List{}, {}
  local caption = pandoc.utils.blocks_to_inlines(pandoc.read(block.attributes.caption or "", "markdown").blocks)
  if numbers[id] and not is_latex then caption = pandoc.Inlines(numbers[id] .. ": ") .. caption end
  for i, command in ipairs(commands_of(block.text)) do
    local printed, made = run(command, id ~= "" and id or "render")
    pictures:extend(made)
    blocks:extend(blocks_of(printed, block))
    echo[i] = "meshfolio " .. command.text
  end
  if #pictures > 0 then
    blocks:insert(figure_of(pictures, block, caption))
  elseif #blocks > 0 then
    if is_latex and id ~= "" then caption:insert(pandoc.RawInline("latex", "\\label{" .. id .. "}")) end
    if blocks[1].t == "Table" and not quarto then blocks[1].caption.long = {pandoc.Plain(caption)} else blocks:insert(pandoc.Para(caption)) end
    blocks = List{pandoc.Div(blocks, {id})}
  end
  if option_of(block, "echo") == "true" then blocks:insert(1, pandoc.CodeBlock(table.concat(echo, "\n"), {"", {"sh"}})) end
  return blocks
end

--- Replaces code by what its commands yield. A failure ends Pandoc with file and line, or becomes a red box.
local function replaced(element)
  if not element.classes:includes("meshfolio") then return nil end
  local file, line, first = document, nil, element.text:match("%S[^\n]*") or " "
  for _, source in ipairs(sources) do
    local at = source.text:find(element.text, source.from, true) or source.text:find(element.text, 1, true) or source.text:find(first, 1, true)
    if at and not line then file, line, source.from = source.name, lines_before(source.text, at) + 1, at + 1 end
  end
  local ok, result = pcall(element.t == "Code" and inlines_of or blocks_of_commands, element)
  if ok or type(result) ~= "table" then return ok and result or error(result, 0) end
  local message = file .. ":" .. (line and line + line_of_block .. ":" or "") .. " " .. result.message
  if option_of(element, "errors") ~= "show" then
    io.stderr:write("meshfolio: ", message, "\n")
    os.exit(83)
  end
  local text = List{is_latex and pandoc.RawInline("latex", "\\color{red}") or pandoc.Str(""), pandoc.Strong(message)}
  local box = pandoc.Span(text, {"", {"meshfolio-error"}, {style = "border: 2px solid; color: #b00020; padding: 0.2em 0.5em"}})
  return element.t == "Code" and box or pandoc.Para{box}
end

--- Returns links in place of @fig-h, for ids of blocks with captions. Quarto has its own.
local function Cite(cite)
  local links = List{}
  for _, citation in ipairs(cite.citations) do
    local text = numbers[citation.id]
    if not text then return nil end
    if is_latex then text = {pandoc.Str(text:match("%a+")), pandoc.RawInline("latex", "~\\ref{" .. citation.id .. "}")} end
    links:extend{pandoc.Str(#links > 0 and ", " or ""), pandoc.Link(text, "#" .. citation.id)}
  end
  return links
end

--- Reads the settings and the sources of the document, and numbers its figures and tables.
local function Pandoc(doc)
  local counts = {Figure = 0, Table = 0}
  for name, value in pairs(doc.meta.meshfolio or {}) do
    local text = name ~= "meshes" and (type(value) == "boolean" and tostring(value) or stringify(value))
    for mesh, names in pairs(text and {} or value) do   -- words, or a list
      meshes[mesh] = pandoc.utils.type(names) == "List" and names:map(function(item) return stringify(item) end) or commands_of(stringify(names))[1]
    end
    if has(FILTER_KEYS, name) then settings[name] = text
    else table.insert(render_options, {name = name, word = "--" .. name .. (text == "true" and "" or "=" .. text)}) end
  end
  table.sort(render_options, function(a, b) return a.name < b.name end)
  if settings.size then table.insert(render_options, {name = "dpi", word = ("--dpi=%.0f"):format(settings.size / 85 * 25.4)}) end   -- of 85 mm
  settings.anywhere = settings["allow-outside"] == "true"
  local data = doc.meta.data and stringify(doc.meta.data) or settings.data and join{folder, settings.data}
  if data then table.insert(folders, 2, join{pandoc.system.get_working_directory(), data}) end
  for i, name in ipairs(quarto and {document} or PANDOC_STATE.input_files) do
    sources[i] = {name = name, text = (contents(name) or ""):gsub("\r\n", "\n"), from = 1}
  end
  pandoc.walk_block(pandoc.Div(doc.blocks), {CodeBlock = function(block)
    local kind = ({fig = "Figure", tbl = "Table"})[block.identifier:match("^(%a+)%-")]
    if quarto or not kind or not block.attributes.caption or not block.classes:includes("meshfolio") then return end
    counts[kind] = counts[kind] + 1
    numbers[block.identifier] = kind .. " " .. counts[kind]
  end})
end

return {{Pandoc = Pandoc}, {traverse = "topdown", CodeBlock = replaced, Code = replaced, Cite = Cite}}
