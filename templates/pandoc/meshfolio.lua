-- Draws and measures meshes in documents of Pandoc (2.17 and later) and Quarto, by the program meshfolio:
--   pandoc --lua-filter meshfolio.lua scan.md -o scan.html
--
-- ```{.meshfolio #fig-h caption="Mean curvature"}     Lines are commands of the program, with quotes as in a shell, but run by no shell.
-- render scan.ply --field h-cotan                     Each yields a figure, a table, or a file for later blocks in <document>_files.
-- ```
-- @fig-h shows the `inspect scan.ply boundary_loops`{.meshfolio} holes; the volume is `inspect scan.ply volume`{.meshfolio digits=3}.
--
-- A command runs again only if it, the contents of its inputs, or the program changed (SHA-1; Pandoc computes no SHA-256).
local COMMANDS = "render inspect curvature spectrum smooth noise compare sample show"
local FLAGS = "json jets rebuild adaptive surfaces terminal edges plain list keep-reached h help"   -- options without a value
local WRITES, READS = "o output out csv ply plot glb vectors html junit", "values colormap trace"   -- options that name outputs and inputs
local FILTER_KEYS = "meshes data errors allow-outside echo digits size"   -- of the metadata; other keys are options of render
local MOST_ROWS, DIGITS, LINE = 40, 4, 72   -- of a table, of a number, unless rows= and digits= are given; characters
local stringify, join, sha1, List = pandoc.utils.stringify, pandoc.path.join, pandoc.utils.sha1, pandoc.List
local program = os.getenv("MESHFOLIO") or "meshfolio"   -- never from the document, which could name any program
local document = quarto and quarto.doc.input_file or PANDOC_STATE.input_files[1] or "document.md"
local folder, is_latex = pandoc.path.directory(document), FORMAT == "latex" or FORMAT == "beamer"
local settings, render_options, meshes, sources, digests, checked, numbers, identity = {}, {}, {}, {}, {}, {}, {}, nil

local function below(root, name) return (root == "." or pandoc.path.is_absolute(name)) and name or join{root, name} end
local files = below(folder, pandoc.path.split_extension(pandoc.path.filename(document)) .. "_files")
local function has(words, word) return (" " .. words .. " "):find(" " .. word .. " ", 1, true) ~= nil end
local function leaves(name) return pandoc.path.is_absolute(name) or ("/" .. name:gsub("\\", "/") .. "/"):find("/../", 1, true) end
local function option_of(element, name) return element.attributes[name] or settings[name] end
local function lines_before(text, at) return select(2, text:sub(1, at - 1):gsub("\n", "")) end
local function refuse(message, line) error({message = message, line = line}, 0) end

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
    if char:match("%s") then
      if word then command:insert(word) end
      if char == "\n" and command then command.text = text:sub(command.first, at - 1) end
      command, word = char ~= "\n" and command or nil, nil
    elseif text:match("^\\\n", at) then
      last = at + 1
    elseif char == "#" and not command then
      last = text:find("\n", at, true) - 1
    elseif char:match("[;|&`]") or char:match("[<>]") and not word then
      refuse("'" .. char .. "' means nothing without a shell; write one command a line, or quote a name", lines_before(text, at))
    else
      command = command or List{}
      if #command == 0 and not word then command.first, command.line, commands[#commands + 1] = at, lines_before(text, at), command end
      if char == "\\" then
        last, char = at + 1, text:sub(at + 1, at + 1)
      elseif char == "'" or char == '"' then
        repeat last = text:find(char, last + 1, true) or refuse("a quote is not closed; close it", lines_before(text, at))
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

--- Returns the path of a name in a folder. Refuses a name that leaves it, also by a symbolic link, unless the metadata allows that.
local function inside(root, name)
  local path = below(root, name)
  if checked[path] or settings["allow-outside"] == "true" then return path end
  local function real(link)   -- the link itself where the system has no such readlink
    local ok, out = pcall(pandoc.pipe, "readlink", {"-m", "--", link}, "")
    return ok and out:gsub("/?\n$", "/") or link .. "/"
  end
  local top = root == files and real(folder) .. pandoc.path.filename(files) .. "/" or real(root)
  if leaves(name) or real(path):find(top, 1, true) ~= 1 then
    refuse("'" .. name .. "' leads out of '" .. root .. "'; use files in there, or set allow-outside in the metadata")
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

--- Returns the path of an input: the first of its names in the first folder that has it.
local function input(name)
  for _, known in ipairs(meshes[name] or {name}) do
    for _, root in ipairs(settings.folders) do
      if leaves(known) and settings["allow-outside"] ~= "true" or digest(below(root, known)) then return inside(root, known) end
    end
  end
end

--- Returns the words for the program, with paths of inputs and outputs; the digests of inputs; the outputs; the set of options.
local function prepare(command)
  local name, words, inputs, outputs, given, at = command[1], List{command[1]}, List{}, List{}, {}, 2
  local inputs_left = has("render compare", name) and math.huge or name == "sample" and 0 or 1   -- words without option that name inputs
  if not has(COMMANDS, name) then refuse("'" .. name .. "' cannot be run here; the commands are " .. COMMANDS:gsub(" ", ", ")) end
  while at <= #command do
    local option, value = command[at]:match("^%-%-([%w-]+)=?(.*)$")
    if not option then option, value = command[at]:match("^%-(%a)(.*)$") end
    if not option then option, value = "", command[at] end
    if value == "" and not has(FLAGS, option) then at, value = at + 1, command[at + 1] or "" end
    local file, column = value:match(option == "values" and "^(.+)(:.*)$" or "^(.*)()$")
    local path = has(WRITES, option) and value ~= "-" and inside(files, value)
    if path then
      outputs:insert(path)
    elseif has(READS, option) or option == "" and inputs_left > 0 then
      path, inputs_left = input(file or value), inputs_left - (option == "" and 1 or 0)
      if path then inputs:insert(digest(path)) end
      if option == "" and not path then refuse("there is no '" .. value .. "' in " .. table.concat(settings.folders, ", ") .. "; check its name") end
    elseif option ~= "title" and leaves(value) then
      refuse("'" .. value .. "' is a path where none may be; take it out")
    end
    words:insert((#option < 2 and option:gsub(".", "-%0") or "--" .. option .. (value ~= "" and "=" or "")) ..
                 (path and path .. (option == "values" and column or "") or value))
    at, given[option] = at + 1, true
  end
  given.o = given.o or given.output
  if name == "sample" and not given.o or given.reconstruct and not given.out then refuse("name the output by -o or --out") end
  return words, inputs, outputs, given
end

--- Runs the program. Returns true and what it printed, or false and the reason.
local function call(words)
  local environment, ok, printed = pandoc.system.environment(), nil, nil
  environment.MESHFOLIO_ERRORS = "stdout"   -- Pandoc gives no standard error
  pandoc.system.with_environment(environment, function() ok, printed = pcall(pandoc.pipe, program, words, "") end)
  return ok, ok and printed or type(printed) == "table" and printed.output:gsub("^meshfolio: ", ""):gsub("\n$", "") or tostring(printed)
end

--- Runs a command unless its result is in the cache. Returns what it printed, and its outputs. @param stem  of the name of a figure
local function run(command, stem)
  local words, inputs, outputs, given = prepare(command)
  local draws = command[1] == "render" and not given.out
  for _, option in ipairs(draws and render_options or {}) do
    if not given[option.name] then words:insert(option.word) end
  end
  if not identity then
    local ok, version = call{"version", "--build"}
    identity = ok and version or refuse("the program '" .. program .. "' does not run; install it, or name it in the variable MESHFOLIO")
  end
  local key = identity .. table.concat(inputs, " ") .. "\0" .. table.concat(words, "\0")
  if draws and not given.o then
    outputs:insert(inside(files, (stem or "render-" .. sha1(key):sub(1, 10)) .. (is_latex and ".pdf" or ".png")))
    words:insert("--output=" .. outputs[#outputs])
  end
  local record = inside(files, join{"cache", sha1(key .. "\0" .. table.concat(outputs, "\0"))})
  local function state() return table.concat(outputs:map(function(path) return digest(path) or "none" end), " ") .. "\n" end
  local kept, now = contents(record) or "", state()
  if kept:sub(1, #now) == now then return kept:sub(#now + 1), outputs end
  for _, path in ipairs{record, table.unpack(outputs)} do
    local parent = pandoc.path.directory(path)
    if pandoc.system.make_directory then pandoc.system.make_directory(parent, true) else pandoc.pipe("mkdir", {"-p", "--", parent}, "") end
  end
  local ok, printed = call(words)
  digests = {}
  local file = io.open(ok and record or refuse(printed), "wb")
  file:write(state(), printed)
  file:close()
  return printed, outputs
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
    if power and power > 0 and power < 7 then shown, power = string.format("%.0f", shown), nil end
    if is_latex then
      return pandoc.RawInline("latex", open .. "$" .. (power and mantissa .. "\\times10^{" .. power .. "}" or shown) .. "$" .. close)
    end
    shown = open .. (power and mantissa .. " × 10" or shown):gsub("-", "−")
    return power and {pandoc.Str(shown), pandoc.Superscript(tostring(power):gsub("-", "−")), pandoc.Str(close)} or pandoc.Str(shown .. close)
  end})
end

--- Returns CSV as a table. Columns of numbers are aligned to the right; the longest column is wrapped if all are too long for a line.
local function table_of(csv, has_head, element)
  local simple, wanted = pandoc.utils.to_simple_table(rounded(pandoc.read(csv, "csv").blocks[1], element)), element.attributes.columns
  local all, most, aligns, widths, total, longest = #simple.rows, tonumber(element.attributes.rows), List{}, List{}, 0, 1
  local names = List(simple.header):map(function(title) return stringify(title) end)
  local chosen = names:map(function(_, i) return i end)
  if wanted then
    chosen = commands_of(wanted:gsub(",", " "))[1]:map(function(name) return select(2, names:find(name)) or refuse("there is no column '" .. name .. "'") end)
  end
  local rows = List{table.unpack(simple.rows, 1, math.min(all, most or MOST_ROWS))}:map(function(row)
    return chosen:map(function(i) return row[i] end)
  end)
  for j, i in ipairs(chosen) do
    local texts = rows:map(function(row) return stringify(row[j]) end)
    aligns[j] = texts:find_if(function(text) return not text:match("^[%d.,()%s−×]*$") end) and "AlignLeft" or "AlignRight"
    widths[j] = math.max(#names[i], table.unpack(texts:map(function(text) return utf8.len(text) end))) + 2
    total, longest = total + widths[j], widths[j] > widths[longest] and j or longest
  end
  widths[longest] = math.max(widths[longest] + LINE - total, 30)
  widths = widths:map(function(width) return total > LINE and width / math.max(LINE, total) or 0 end)
  local head = has_head and chosen:map(function(i) return {pandoc.Plain((names[i]:gsub("_", " ")))} end) or {}
  local shown = pandoc.utils.from_simple_table(pandoc.SimpleTable({}, aligns, widths, head, rows))
  return {shown, #rows < all and not most and pandoc.Para("… and " .. all - #rows .. " more rows") or nil}
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

--- Returns an image, named from the folder of the document that is written. In pages it is as wide as the file says.
local function image_of(path, caption, given)
  local written, shown, width = pandoc.path.directory(PANDOC_STATE.output_file or "x"), path, given.width
  if written ~= "." and not is_latex then
    shown = pandoc.path.make_relative(path, written, true)
    pandoc.mediabag.insert(shown, nil, contents(path))   -- for writers that embed pictures
  end
  shown = shown:gsub("[%%#?]", function(char) return ("%%%02X"):format(char:byte()) end)
  local bytes = FORMAT:match("html") and path:match("%.png$") and contents(path) or ""
  local per_metre = bytes:match("pHYs(....)")
  if per_metre and not width then width = math.floor((">I4"):unpack(bytes, 17) / (">I4"):unpack(per_metre) * 1000 + 0.5) .. "mm" end
  return pandoc.Image(caption, shown, "", {"", {}, {width = width, height = given.height, alt = given.alt}})
end

--- Returns the figure of a block: an image, or several above one caption.
local function figure_of(paths, block, caption)
  local id, images = block.identifier, List{}
  local function raw(text) return List{pandoc.RawInline("latex", text)} end
  for i, path in ipairs(paths) do
    local alt = #paths == 1 and #caption > 0 and caption or block.attributes.alt or block.text
    images:extend{image_of(path, alt, block.attributes), i < #paths and pandoc.Space() or nil}
  end
  if #caption == 0 then return pandoc.Div({pandoc.Para(images)}, {id}) end
  if pandoc.Figure then return pandoc.Figure({pandoc.Plain(images)}, {long = {pandoc.Plain(caption)}}, {id}) end
  if #paths == 1 then
    images[1].title, images[1].identifier = "fig:", id   -- a figure of Pandoc 2
  elseif is_latex then
    images = raw("\\begin{figure}\n\\centering\n") .. images .. raw("\n\\caption{") .. caption .. raw("}\\label{" .. id .. "}\n\\end{figure}")
  else
    return pandoc.Div({pandoc.Para(images), pandoc.Para(caption)}, {id, {"figure"}})
  end
  return pandoc.Para(images)
end

--- Returns the inlines that one command in running text yields.
local function inlines_of(code)
  local commands = commands_of(code.text)
  local printed = #commands == 1 and run(commands[1]) or refuse("write one command here")
  return rounded(pandoc.Plain((printed:gsub("%s+$", ""))), code).content
end

--- Returns the blocks that the commands of a block yield.
local function blocks_of_commands(block)
  local id, blocks, pictures, echo = block.identifier, List{}, List{}, {}
  local caption = pandoc.utils.blocks_to_inlines(pandoc.read(block.attributes.caption or "", "markdown").blocks)
  local function is_picture(path) return path:match("%.png$") or path:match("%.svg$") or path:match("%.pdf$") end
  if numbers[id] and not is_latex then caption = pandoc.Inlines(numbers[id] .. ": ") .. caption end
  for i, command in ipairs(commands_of(block.text)) do
    local ok, printed, outputs = pcall(run, command, id ~= "" and id:gsub("[^%w_-]", "-") .. (#pictures > 0 and "-" .. i or ""))
    if not ok then error(type(printed) == "table" and {message = printed.message, line = command.line} or printed, 0) end
    local named = printed:match("([^\n]+)\n$") or ""   -- a picture that `show` names, or the sheet of `render --out`
    if is_picture(named) and contents(named) then printed, outputs = "", outputs:includes(named) and outputs or {named} end
    pictures:extend(List(outputs):filter(is_picture))
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
  local message = file .. ":" .. (line and line + (result.line or 0) .. ":" or "") .. " " .. result.message
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
  local data = doc.meta.data and stringify(doc.meta.data) or settings.data and below(folder, settings.data)
  settings.folders = List{files, data or folder, data and folder}
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
