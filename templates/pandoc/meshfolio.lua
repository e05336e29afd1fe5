-- Draws and measures meshes in documents of Pandoc (2.17 and later) and Quarto:  pandoc --lua-filter meshfolio.lua scan.md -o scan.html
-- ```{.meshfolio #fig-h caption="Mean curvature"}     Lines are commands of meshfolio, with quotes as in a shell, but run by no shell.
-- render scan.ply --field h-cotan                     Each yields a figure, a table, or a file for later blocks in <document>_files.
-- ```                                                 Text: @fig-h shows the `inspect scan.ply boundary_loops`{.meshfolio digits=3} holes.
local COMMANDS = "render inspect curvature spectrum smooth noise compare sample show"
local WRITES = "o output out csv ply plot glb vectors html junit summary"   -- options that name outputs
local FILTER_KEYS = "meshes data errors allow-outside echo digits size"   -- of the metadata; other keys are options of render
local MOST_ROWS, DIGITS, LINE = 40, 4, 72   -- of a table, of a number, unless rows= and digits= are given; characters of a line
local stringify, sha1, List, path = pandoc.utils.stringify, pandoc.utils.sha1, pandoc.List, pandoc.path
local program = os.getenv("MESHFOLIO") or "meshfolio"   -- never from the document, which could name any program
local document = quarto and quarto.doc.input_file or PANDOC_STATE.input_files[1] or "document.md"
local folder, written = path.directory(document), path.directory(PANDOC_STATE.output_file or "x")
local files = path.normalize(path.join{folder, path.split_extension(path.filename(document)) .. "_files"})   -- where the filter works
local shown_files = written == "." and files or path.make_relative(files, written, true)   -- as from the document that is written
local settings, options, meshes, folders, sources, numbers = {}, List{}, {}, List{".", ".."}, {}, {}
local digests, checked, line_of_block, identity, is_latex = {}, {}, 0, nil, FORMAT == "latex" or FORMAT == "beamer"
local function has(words, word) return (" " .. words .. " "):find(" " .. word .. " ", 1, true) ~= nil end
local function option_of(element, name) return element.attributes[name] or settings[name] end
local function lines_before(text, at) return select(2, text:sub(1, at - 1):gsub("\n", "")) end
local function refuse(message) error({message = message}, 0) end
local function contents(name)   -- nil without such a file, or for a folder
  local file = io.open(name, "rb")
  local text, _ = file and file:read("a"), file and file:close()
  return text
end
local function commands_of(text)   -- splits it into {words…, line= from 0}, with quotes and escapes of a POSIX shell, without its other powers
  local commands, command, is_open, at = List{}, nil, false, 1
  local function take(pattern)   -- returns what matches here, and goes behind it
    local found, behind = text:match("^" .. pattern .. "()", at)
    at = behind or at
    return found
  end
  while at <= #text do
    line_of_block = lines_before(text, at)
    local comment = not command and take("(#[^\n]*)")
    local piece = take("'([^']*)'") or take("\\([^\n])") or take("([^%s'\"\\;|&`<>]+)") or is_open and take("([<>])")
    if not piece and take('(")') then
      piece = ""
      repeat piece = piece .. (take('([^"\\]+)') or take("(\\\n)") and "" or take('\\([\\"$`])') or take("(\\)") or "")
      until take('(")') or at > #text and refuse("a quote is not closed; close it")
    end
    if piece and not comment then
      if not command then commands:insert(List{line = line_of_block}) end
      command = commands[#commands]
      command[#command + (is_open and 0 or 1)] = (is_open and command[#command] or "") .. piece
      is_open = true
    elseif not take("(\\\n)") then
      command, is_open = text:sub(at, at) ~= "\n" and command or nil, false
      if not comment and not take("(%s)") then refuse("'" .. text:sub(at, at) .. "' means nothing without a shell; close or add quotes") end
    end
  end
  return commands
end
local function digest(name)   -- of a file, or of the results in the folder of a report; nil if there is none
  local bytes = not digests[name] and (contents(name) or contents(path.join{name, "results.json"}))
  digests[name] = bytes and sha1(bytes) or digests[name]
  return digests[name]
end
local function real(name)   -- without symbolic links; as it is where the system has no such readlink
  local ok, out = pcall(pandoc.pipe, "readlink", {"-m", "--", name}, "")
  return ok and out:gsub("/?\n$", "/") or name .. "/"
end
local function place(name, is_output)   -- path of an output, or of an input in the first folder that has it; nothing may lead out of a folder
  local is_free = settings["allow-outside"] == "true"
  local leaves = not is_free and (path.is_absolute(name) or ("/" .. name:gsub("\\", "/") .. "/"):find("/../", 1, true))
  for _, root in ipairs(folders) do
    local found = path.normalize(path.join{root, name})
    if is_output or leaves or digest(found) then
      local top = root == "." and real("..") .. path.filename(files) .. "/" or real(root)   -- the folder of files is no link
      checked[found] = checked[found] or is_free or real(found):find(top, 1, true) == 1
      if checked[found] and not leaves then return found end
      refuse("'" .. name .. "' leads out of the folders of the document; use files in there, or set allow-outside in the metadata")
    end
  end
end
local function prepare(command)   -- returns words for the program, digests of inputs, outputs, the set of options
  local words, inputs, outputs, given = List{command[1]}, List{}, List{}, {}
  if not has(COMMANDS, command[1]) then refuse("'" .. command[1] .. "' cannot be run here; the commands are " .. COMMANDS:gsub(" ", ", ")) end
  for i = 2, #command do
    local start, value = command[i]:match("^(%-%-[%w-]+=)(.*)$")
    local option, name, column = (start or command[i - 1]):match("^%-%-?(%a[%w-]*)=?$") or "", value or command[i], ""
    if command[i]:match("^%-%a.") then refuse("'" .. command[i] .. "' is no option; write a blank behind its letter") end
    if option == "values" then name, column = name:match("^(.-)(:?[^:]*)$") end
    local is_output, found = has(WRITES, option) and name ~= "-", nil
    for _, known in ipairs(not is_output and meshes[name] or {name}) do found = found or option ~= "title" and place(known, is_output) end
    if found then (is_output and outputs or inputs):insert(is_output and found or digest(found)) end
    given[option], given[command[i]:match("^%-%-?(%a[%w-]*)") or ""] = true, true
    words:insert((start or "") .. (found or name) .. column)
  end
  return words, inputs, outputs, given
end
local function call(words)   -- returns what the program prints
  local ok, printed = pcall(pandoc.pipe, program, words, "")
  if ok then return printed end
  if type(printed) ~= "table" then refuse("the program '" .. program .. "' does not run; install it, or name it in MESHFOLIO") end
  refuse(printed.output ~= "" and printed.output:gsub("^meshfolio: ", ""):gsub("\n$", "") or "the program ended with code " .. printed.error_code)
end
local function run(command, stem)   -- unless it, its inputs (by SHA-1) and the program are as before; returns what it printed, and its pictures
  line_of_block, identity = command.line, identity or call{"version", "--build"}
  local words, inputs, outputs, given = prepare(command)
  local draws = command[1] == "render" and not given.out
  if draws then words:extend(options:filter(function(word) return not given[word:match("[%w-]+", 3)] end)) end
  local key = identity .. table.concat(inputs, " ") .. "\0" .. table.concat(words, "\0")
  if draws and not (given.o or given.output) then
    outputs:insert(place(stem:gsub("[^%w_-]", "-") .. "-" .. sha1(key):sub(1, 8) .. (is_latex and ".pdf" or ".png"), true))
    words:extend{"-o", outputs[#outputs]}
  end
  local function is_picture(name) return name:match("%.png$") or name:match("%.svg$") or name:match("%.pdf$") end
  local pictures = outputs:filter(is_picture)   -- else the one that is printed last, by `show` or `render --out`
  local record = place("cache", true) .. "/" .. sha1(key .. table.concat(outputs, "\0"))
  local function state(printed)   -- digests of all files that were written
    for line in printed:gmatch("[^\n]+") do outputs:insert(contents(line) and not outputs:includes(line) and line or nil) end
    return table.concat(outputs:map(function(name) return digest(name) or "none" end), " ") .. "\n"
  end
  local kept = contents(record) or ""
  local printed = kept:match("\n(.*)$") or ""
  if state(printed) .. printed ~= kept then
    printed, digests = call(words), {}
    io.open(record, "wb"):write(state(printed), printed):close()
  end
  printed = printed:gsub("[^\n]+\n", function(line) return contents(line:sub(1, -2)) and "" end)
  return printed, pictures[1] and pictures or List{outputs[#outputs]}:filter(is_picture)
end
local function rounded(content, element)   -- rounds numbers for people, whole ones only if digits are given
  local digits = tonumber(option_of(element, "digits"))
  return pandoc.walk_block(content, {Str = function(str)
    if not tonumber(str.text) or not (digits or str.text:find("[.eE]")) then return nil end
    local text = ("%." .. (digits or DIGITS) .. "g"):format(str.text)
    local mantissa, power = text:match("^(.*)e(.*)$")
    if power and tonumber(power) > 0 and tonumber(power) < 7 then return pandoc.Str(("%.0f"):format(text)) end
    return power and {pandoc.Str(mantissa .. "×10"), pandoc.Superscript(tostring(math.tointeger(power)))} or pandoc.Str(text)
  end})
end
local function table_of(csv, has_head, element)   -- columns of numbers are on the right, long lines wrapped
  local simple, widths, total = pandoc.utils.to_simple_table(rounded(pandoc.read(csv, "csv").blocks[1], element)), {}, 0
  local most = tonumber(element.attributes.rows) or #simple.rows < MOST_ROWS and MOST_ROWS
  simple.rows = List{table.unpack(simple.rows, 1, most or refuse("the table has " .. #simple.rows .. " rows; say by rows= how many to show"))}
  for j, title in ipairs(simple.header) do
    local texts = simple.rows:map(function(row) return stringify(row[j]) end)
    local is_text = texts:find_if(function(text) return not text:match("^[%d.%s+×-]*$") end)
    widths[j] = math.min(50, math.max(#stringify(title), table.unpack(texts:map(function(text) return #text end))) + 2)
    simple.aligns[j], total = is_text and "AlignLeft" or "AlignRight", total + widths[j]
    simple.header[j] = {pandoc.Plain((stringify(title):gsub("_", " ")))}
  end
  for j, width in ipairs(widths) do simple.widths[j] = total > LINE and width / total or 0 end
  if not has_head then simple.header = {} end
  return pandoc.utils.from_simple_table(simple)
end
local function blocks_of(text, element)   -- makes CSV, and columns parted by two blanks, tables; other lines paragraphs
  if text:match("^[^\n]*,[^ \n]*\n") then return {table_of(text, true, element)} end
  local blocks, rows, commas = List{}, "", ""
  for line in (text .. "\n"):gmatch("(.-)\n") do
    local cells, gaps = line:gsub('"', '""'):gsub("%s%s+", '","')
    if gaps > 0 then
      rows, commas = rows .. '"' .. cells:gsub("_", " ") .. '"\n', gaps > #commas and (","):rep(gaps) or commas
    else
      if rows ~= "" then blocks:insert(table_of(commas .. "\n" .. rows, false, element)) end
      if line ~= "" then blocks:insert(rounded(pandoc.Para(line), element)) end
      rows = ""
    end
  end
  return blocks
end
local function figure_of(pictures, block, caption)   -- an image, or several above one caption
  local id, given, is_figure = block.identifier, block.attributes, #pictures == 1 and caption[1]
  local alt, title = is_figure and caption or given.alt or block.text, is_figure and "fig:" or ""
  local images = pictures:map(function(name)
    local shown = path.normalize(path.join{shown_files, name})
    pandoc.mediabag.insert(shown, nil, contents(name))   -- for writers that embed pictures
    shown = shown:gsub("[%%#?]", function(char) return ("%%%02X"):format(char:byte()) end)
    return pandoc.Image(alt, shown, title, {is_figure and id or "", {}, {width = given.width, height = given.height, alt = given.alt}})
  end)
  if pandoc.Figure and caption[1] then return pandoc.Figure({pandoc.Plain(images)}, {long = {pandoc.Plain(caption)}}, {id}) end
  if is_latex and not is_figure then caption:insert(1, pandoc.RawInline("latex", "\\refstepcounter{figure}\\label{" .. id .. "}Figure \\thefigure: ")) end
  return is_figure and pandoc.Para(images) or pandoc.Div({pandoc.Para(images), caption[1] and pandoc.Para(caption) or nil}, {id})
end
local function blocks_of_commands(block)   -- returns what the commands of a block yield
  local id, blocks, pictures = block.identifier, List{}, List{}
  local caption = pandoc.utils.blocks_to_inlines(pandoc.read(block.attributes.caption or "", "markdown").blocks)
  if numbers[id] and not is_latex then caption = pandoc.Inlines(numbers[id] .. ": ") .. caption end
  for _, command in ipairs(commands_of(block.text)) do
    local printed, made = run(command, id ~= "" and id or "render")
    pictures:extend(made)
    blocks:extend(blocks_of(printed, block))
  end
  if pictures[1] then
    blocks:insert(figure_of(pictures, block, caption))
  elseif blocks[1] then
    if is_latex and numbers[id] then caption:insert(pandoc.RawInline("latex", "\\label{" .. id .. "}")) end
    if blocks[1].t == "Table" and not quarto then blocks[1].caption.long = {pandoc.Plain(caption)} else blocks:insert(pandoc.Para(caption)) end
    blocks = List{pandoc.Div(blocks, {id})}
  end
  if option_of(block, "echo") == "true" then blocks:insert(1, pandoc.CodeBlock(block.text, {"", {"sh"}})) end
  return blocks
end
local function inlines_of_command(code)   -- returns what a command in running text yields
  local printed = run(commands_of(code.text)[1] or refuse("write a command here"), "render")
  return rounded(pandoc.Plain((printed:gsub("%s+$", ""))), code).content
end
local function replaced(element)   -- code by what its commands yield; a failure ends Pandoc with file and line, or becomes a red box
  if not element.classes:includes("meshfolio") then return nil end
  local where, line = document, nil
  for _, source in ipairs(sources) do
    local at = source.text:find(element.text, source.from, true) or source.text:find(element.text:match("%S[^\n]*") or " ", 1, true)
    if at and not line then where, line, source.from = source.name, lines_before(source.text, at) + 1, at + 1 end
  end
  local ok, result = pcall(element.t == "Code" and inlines_of_command or blocks_of_commands, element)
  if ok or type(result) ~= "table" then return ok and result or error(result, 0) end
  local message = where .. ":" .. (line and line + line_of_block .. ":" or "") .. " " .. result.message
  if option_of(element, "errors") ~= "show" then io.stderr:write("meshfolio: ", message, "\n") os.exit(83) end
  local text = {pandoc.RawInline("latex", "\\color{red}"), pandoc.Strong(message)}
  local box = pandoc.Span(text, {"", {"meshfolio-error"}, {style = "border: 2px solid; color: #b00020; padding: 0.2em 0.5em"}})
  return element.t == "Code" and box or pandoc.Para{box}
end
local function Cite(cite)   -- returns a link in place of @fig-h; LaTeX numbers by itself
  local id = #cite.citations == 1 and cite.citations[1].id
  local latex = numbers[id] and pandoc.RawInline("latex", numbers[id]:gsub(" .*", "~\\ref{" .. id .. "}"))
  return numbers[id] and pandoc.Link(is_latex and {latex} or numbers[id], "#" .. id)
end
function Pandoc(doc)
  local environment, counts, is_used = pandoc.system.environment(), {}, #PANDOC_STATE.input_files == 0
  for name, value in pairs(doc.meta.meshfolio or {}) do
    local text = name ~= "meshes" and (type(value) == "boolean" and tostring(value) or stringify(value))
    for mesh, names in pairs(text and {} or value) do   -- a list, or words
      meshes[mesh] = pandoc.utils.type(names) == "List" and names:map(function(item) return stringify(item) end) or commands_of(stringify(names))[1]
    end
    if has(FILTER_KEYS, name) then settings[name] = text else options:insert("--" .. name .. (text == "true" and "" or "=" .. text)) end
  end
  if settings.size then options:insert(("--dpi=%.0f"):format(settings.size / 85 * 25.4)) end   -- pixels of 85 mm
  options:sort()
  local function add_folder(name) folders:insert(2, path.join{pandoc.system.get_working_directory(), name}) end
  if settings.data then add_folder(path.join{folder, settings.data}) end
  if doc.meta.data then add_folder(stringify(doc.meta.data)) end
  for i, name in ipairs(quarto and {document} or PANDOC_STATE.input_files) do
    sources[i] = {name = name, text = (contents(name) or ""):gsub("\r\n", "\n"), from = 1}
    is_used = is_used or sources[i].text:find(".meshfolio", 1, true)
  end
  doc:walk{CodeBlock = function(block)
    local kind = block.classes:includes("meshfolio") and ({fig = "Figure ", tbl = "Table "})[block.identifier:match("^(%a+)%-")]
    counts[kind or ""] = (counts[kind or ""] or 0) + 1
    numbers[block.identifier] = kind and not quarto and kind .. counts[kind] or nil
  end}
  if not is_used then return nil end
  pandoc.pipe("mkdir", {"-p", "--", path.join{files, "cache"}}, "")   -- Pandoc 2.17 makes none
  environment.MESHFOLIO_ERRORS = "stdout"                             -- Pandoc gives no standard error
  pandoc.system.with_environment(environment, function() pandoc.system.with_working_directory(files, function()
    doc = doc:walk{traverse = "topdown", CodeBlock = replaced, Code = replaced, Cite = Cite}
  end) end)
  return doc
end
