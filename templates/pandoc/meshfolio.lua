-- Draws and measures meshes in documents of Pandoc (2.17 and later) and Quarto, by the program meshfolio:
--   pandoc --lua-filter meshfolio.lua scan.md -o scan.html
--
-- ```{.meshfolio #fig-h caption="Mean curvature" echo=true}     One command a line; quotes as in a shell, but no shell and no variables.
-- render scan.ply --field h-cotan                               A command yields a figure, a table, or a file for later blocks.
-- ```
-- The scan has `inspect scan.ply boundary_loops`{.meshfolio} holes and a volume of `inspect scan.ply volume`{.meshfolio digits=3}.
--
-- Outputs are in <document>_files. A command runs again only if it, its inputs or the program changed (SHA-1, as Pandoc has no SHA-256).
local COMMANDS = "render inspect curvature spectrum smooth noise compare sample show"
local FLAGS = "json jets rebuild adaptive surfaces terminal edges plain list keep-reached h help"   -- options without a value
local WRITES = "o output out csv ply plot glb vectors html junit"                                     -- options that name outputs
local READS = "values colormap trace"                                                                 -- options that may name inputs
local FILTER_KEYS = "meshes data errors allow-outside echo digits rows size"   -- keys of the metadata; all others are options of render
local WHOLE_TABLE, DIGITS = 40, 4                                              -- rows and digits that are shown unless rows= and digits= say others
local stringify, join, sha1 = pandoc.utils.stringify, pandoc.path.join, pandoc.utils.sha1
local program = os.getenv("MESHFOLIO") or "meshfolio"   -- not from the document, which could name any other
local document = quarto and quarto.doc.input_file or PANDOC_STATE.input_files[1] or "document.md"
local folder = pandoc.path.directory(document)
local function below(root, name) return root == "." and name or join{root, name} end
local files = below(folder, pandoc.path.split_extension(pandoc.path.filename(document)) .. "_files")
local is_latex = FORMAT == "latex" or FORMAT == "beamer"
local settings, sources, digests, real_paths, identity = {meshes = {}, render = {}}, {}, {}, {}, nil

local function has(words, word) return (" " .. words .. " "):find(" " .. word .. " ", 1, true) ~= nil end

local function contents(path)
  local file = io.open(path, "rb")
  local text = file and file:read("a")   -- nil for a folder
  if file then file:close() end
  return text
end

--- Gives up a block, because of the line `line` of its text, counted from 0.
local function refuse(message, line) error({message = message, line = line}, 0) end

--- Splits a text into commands {words…, line=, text=}, with the quotes of a POSIX shell and none of its other powers.
local function commands_of(text)
  local commands, command, word, at, line = {}, {line = 0, first = 1}, nil, 1, 0
  local function end_word()
    if word then table.insert(command, word) end
    word = nil
  end
  local function end_command(last)
    end_word()
    command.text = text:sub(command.first, last)
    if #command > 0 then table.insert(commands, command) end
    command = {line = line, first = last + 2}
  end
  while at <= #text do
    local char, last = text:sub(at, at), at
    local following = text:sub(at + 1, at + 1)
    if char == "\n" then
      line = line + 1
      end_command(at - 1)
    elseif char == "#" and #command == 0 and not word then
      last = (text:find("\n", at, true) or #text + 1) - 1
    elseif char:match("%s") then
      end_word()
    elseif char == "'" or char == '"' then
      last = at + 1
      while text:sub(last, last) ~= char do
        if last > #text then refuse("the quote " .. char .. " is not closed; close it", command.line) end
        last = last + (char == '"' and text:sub(last, last) == "\\" and 2 or 1)
      end
      local inner = text:sub(at + 1, last - 1)
      line = line + select(2, inner:gsub("\n", ""))
      word = (word or "") .. (char == "'" and inner or inner:gsub("\\\n", ""):gsub('\\([\\"$`])', "%1"))
    elseif char == "\\" then
      last = at + 1
      if following == "\n" then line = line + 1 else word = (word or "") .. following end
    elseif char:match("[;|&`]") or (char:match("[<>]") and not word) then
      refuse("'" .. char .. "' means nothing without a shell; write one command a line, or quote it as part of a name", line)
    else
      word = (word or "") .. char
    end
    at = last + 1
  end
  end_command(#text)
  return commands
end

--- Returns the absolute path without symbolic links; the path itself where the system has no such readlink.
local function real(path)
  if not real_paths[path] then
    local ok, out = pcall(pandoc.pipe, "readlink", {"-m", "--", path}, "")
    real_paths[path] = ok and out:gsub("\n$", "") or path
  end
  return real_paths[path]
end

local function leaves(name)
  return pandoc.path.is_absolute(name) or ("/" .. name:gsub("\\", "/") .. "/"):find("/../", 1, true) ~= nil
end

--- Returns the path of a name in a folder. Refuses names that leave it, also by a symbolic link, unless the metadata allows it.
local function inside(root, name)
  local path = pandoc.path.is_absolute(name) and name or below(root, name)
  if settings.anywhere then return path end
  if leaves(name) or (contents(path) or root == files) and real(path):find(real(root):gsub("/$", "") .. "/", 1, true) ~= 1 then
    refuse("'" .. name .. "' leads out of " .. root .. "; use files inside it, or set allow-outside in the metadata")
  end
  return path
end

--- Returns the SHA-1 of a file, or of the results in the folder of a report; nil if there is none.
local function digest(path)
  if not digests[path] then
    local bytes = contents(path) or contents(join{path, "results.json"})
    digests[path] = bytes and sha1(bytes)
  end
  return digests[path]
end

--- Returns the path of an input: the first name and folder that has it.
local function input(name)
  for _, known in ipairs(settings.meshes[name] or {name}) do
    for _, root in ipairs(settings.folders) do
      local path = inside(root, known)
      if digest(path) then return path end
    end
  end
end

--- Returns the words of a command as {option=, value=}, without option for those that stand alone.
local function arguments_of(command)
  local arguments, at = {}, 2
  while at <= #command do
    local word = command[at]
    local option, value = word:match("^%-%-([%w-]+)=(.*)$")
    if not option then
      option = word:match("^%-%-([%w-]+)$") or word:match("^%-(%a)")
      value = word:match("^%-%a(.+)$")
      if not option then value = word elseif not value and not has(FLAGS, option) then at, value = at + 1, command[at + 1] end
    end
    table.insert(arguments, {option = option, value = value})
    at = at + 1
  end
  return arguments
end

--- Returns the words for the program, in which inputs and outputs are paths, the outputs, and the digests of the inputs.
local function prepare(command)
  local name, words, outputs, key, given = command[1], {command[1]}, {}, {}, {}
  local files_left = (name == "render" or name == "compare") and math.huge or name == "sample" and 0 or 1
  local function path_of(option, value)
    local file, column = value, ""
    if option == "values" then file, column = value:match("^(.-)(:?[^:]*)$") end
    if option and has(WRITES, option) and value ~= "-" then
      table.insert(outputs, inside(files, value))
      return outputs[#outputs]
    elseif option and has(READS, option) or not option and files_left > 0 then
      local path = input(file)
      files_left = files_left - (option and 0 or 1)
      if path then table.insert(key, digest(path)) return path .. column end
      if not option then refuse("no file '" .. file .. "' in " .. table.concat(settings.folders, ", ") .. "; check its name") end
    end
    if option ~= "title" and leaves(value) then refuse("'" .. value .. "' is a path, which --" .. (option or "") .. " cannot have here") end
    return value
  end
  for _, argument in ipairs(arguments_of(command)) do
    local option, value = argument.option, argument.value and path_of(argument.option, argument.value)
    given[option or ""] = true
    if option and #option > 1 then table.insert(words, "--" .. option .. (value and "=" .. value or ""))
    elseif option then table.insert(words, "-" .. option) end
    if value and not (option and #option > 1) then table.insert(words, value) end
  end
  given.o = given.o or given.output
  if name == "sample" and not given.o then refuse("sample needs -o FILE; name the mesh") end
  if given.reconstruct and not given.out then refuse("--reconstruct needs --out FOLDER; name one") end
  if name == "render" and not given.out then
    for _, option in ipairs(settings.render) do
      if not given[option.name] then table.insert(words, option.word) end
    end
  end
  return words, outputs, key, name == "render" and not given.o and not given.out
end

local function make_folder(path)
  if pandoc.system.make_directory then pandoc.system.make_directory(path, true) else pandoc.pipe("mkdir", {"-p", "--", path}, "") end
end

local function call(words)
  local environment = pandoc.system.environment()
  environment.MESHFOLIO_ERRORS = "stdout"   -- Pandoc gives no standard error
  local ok, printed
  pandoc.system.with_environment(environment, function() ok, printed = pcall(pandoc.pipe, program, words, "") end)
  return ok, printed
end

--- Runs a command, or takes its result from the cache. Returns what it printed, and its outputs.
local function run(command, stem)
  if not has(COMMANDS, command[1]) then refuse("'" .. command[1] .. "' cannot be run here; the commands are " .. COMMANDS:gsub(" ", ", ")) end
  if not identity then
    local ok, version = call{"version", "--build"}
    if not ok then refuse("the program '" .. program .. "' cannot be run; install it, or name it in the variable MESHFOLIO") end
    identity = version
  end
  local words, outputs, inputs, makes_figure = prepare(command)
  local said = identity .. table.concat(inputs, " ") .. "\n" .. table.concat(words, "\0")
  if makes_figure then
    table.insert(outputs, join{files, (stem or "render-" .. sha1(said):sub(1, 10)) .. (is_latex and ".pdf" or ".png")})
    table.insert(words, "-o")
    table.insert(words, outputs[#outputs])
  end
  local record = join{files, "cache", sha1(said .. "\0" .. table.concat(outputs, "\0"))}
  local function digests_of_outputs()
    local all = {}
    for i, path in ipairs(outputs) do
      digests[path] = nil
      all[i] = digest(path) or "none"
    end
    return table.concat(all, " ") .. "\n"
  end
  local kept, made = contents(record), digests_of_outputs()
  if kept and kept:sub(1, #made) == made then return kept:sub(#made + 1), outputs end
  make_folder(join{files, "cache"})
  for _, path in ipairs(outputs) do make_folder(pandoc.path.directory(path)) end
  local ok, printed = call(words)
  if not ok then
    refuse(type(printed) == "table" and printed.output ~= "" and printed.output:gsub("^meshfolio: ", ""):gsub("\n$", "") or "the command failed: " .. tostring(printed))
  end
  digests = {}
  local file = io.open(record, "wb")
  file:write(digests_of_outputs(), printed)
  file:close()
  return printed, outputs
end

--- Returns a number in the form that people read, or nil for other words and for whole numbers of which no digits are asked.
local function rounded(word, digits)
  local value = not word:find("[xXnN]") and tonumber(word)
  if not value then return nil end
  if word:match("^%-?%d+$") and not digits then return (word:gsub("-", "−")) end
  local text = string.format("%." .. math.max(1, math.min(tonumber(digits) or DIGITS, 17)) .. "g", value)
  local mantissa, exponent = text:match("^(.-)e(.*)$")
  if exponent and tonumber(exponent) > 0 and tonumber(exponent) < 7 then text, exponent = string.format("%.0f", tonumber(text)), nil end
  if not exponent then return (text:gsub("-", "−")) end
  return (mantissa:gsub("-", "−")) .. " × 10", (tostring(math.tointeger(tonumber(exponent))):gsub("-", "−"))
end

--- Returns words as inlines, numbers rounded.
local function inlines_of(text, digits)
  local inlines = pandoc.List()
  for word in text:gmatch("%S+") do
    local number, exponent = rounded(word, digits)
    if #inlines > 0 then inlines:insert(pandoc.Space()) end
    inlines:insert(pandoc.Str(number or word))
    if exponent then inlines:insert(pandoc.Superscript(exponent)) end
  end
  return inlines
end

--- Returns rows of texts as a table. Columns of numbers are aligned to the right, long lines wrapped.
local function table_of(head, rows, options)
  local aligns, widths, longest, total = {}, {}, {}, 0
  local limit, cells = tonumber(options.rows) or WHOLE_TABLE, {}
  for i, row in ipairs(rows) do
    if i > limit then table.insert(cells, {{pandoc.Plain{pandoc.Str("… " .. #rows - limit .. " more")}}}) break end
    cells[i] = {}
    for j, text in ipairs(row) do
      cells[i][j] = {pandoc.Plain(inlines_of(text, options.digits))}
      longest[j] = math.max(longest[j] or 1, #stringify(cells[i][j]))
      aligns[j] = (text == "" or rounded(text)) and (aligns[j] or "AlignRight") or "AlignLeft"
    end
  end
  for j = 1, #longest do
    local title = head and (head[j] or ""):gsub("_", " ") or ""
    longest[j], total = math.max(longest[j], #title), total + math.max(longest[j], #title)
    if head then head[j] = {pandoc.Plain(inlines_of(title))} end
  end
  for j = 1, #longest do widths[j] = total > 80 and longest[j] / total or 0 end
  for _, row in ipairs(cells) do
    for j = #row + 1, #longest do row[j] = {} end
  end
  return pandoc.utils.from_simple_table(pandoc.SimpleTable({}, aligns, widths, head or {}, cells))
end

--- Returns what a command printed as blocks: CSV and columns parted by two blanks as tables, other lines as paragraphs.
local function blocks_of(text, options)
  local blocks, rows = pandoc.List(), {}
  if text:match("^[^\n]-,[^\n]*\n") and not text:match("^[^\n]*  ") then
    local csv = pandoc.utils.to_simple_table(pandoc.read(text, "csv").blocks[1])
    local function texts(cells)
      local row = {}
      for i, cell in ipairs(cells) do row[i] = stringify(cell) end
      return row
    end
    for i, row in ipairs(csv.rows) do rows[i] = texts(row) end
    return pandoc.List{table_of(texts(csv.header), rows, options)}
  end
  local function end_table()
    if #rows > 0 then blocks:insert(table_of(nil, rows, options)) end
    rows = {}
  end
  for line in text:gmatch("[^\n]+") do
    local row = {}
    for cell in (line .. "  "):gmatch("(.-)%s%s+") do table.insert(row, cell) end
    if #row > 1 then
      row[1] = row[1]:gsub("_", " ")
      table.insert(rows, row)
    else
      end_table()
      blocks:insert(pandoc.Para(inlines_of(line, options.digits)))
    end
  end
  end_table()
  return blocks
end

--- Returns an image of a file for the document that is written, whose pictures may have to be named from its own folder.
local function image_of(path, caption, attributes)
  local shown, written = path, pandoc.path.directory(PANDOC_STATE.output_file or "x")
  if written ~= "." and not is_latex then
    shown = pandoc.path.make_relative(path, written, true)
    pandoc.mediabag.insert(shown, nil, contents(path))   -- for writers that embed pictures
  end
  local bytes = FORMAT:match("html") and path:match("%.png$") and not attributes.width and contents(path) or ""
  local per_metre = bytes:match("pHYs(....)")
  if per_metre then
    local pixels = (">I4"):unpack(bytes, 17)
    attributes.width = string.format("%.0fmm", pixels / (">I4"):unpack(per_metre) * 1000)
  end
  return pandoc.Image(caption, shown, "", pandoc.Attr("", {}, attributes))
end

--- Returns the figure of a block: an image or several above one caption.
local function figure_of(paths, block, caption)
  local images = pandoc.List()
  for _, path in ipairs(paths) do
    local attributes = {width = block.attributes.width, height = block.attributes.height, alt = block.attributes.alt}
    images:insert(image_of(path, #paths == 1 and #caption > 0 and caption or inlines_of(attributes.alt or block.text), attributes))
  end
  if #caption == 0 then return pandoc.Div({pandoc.Para(images)}, {block.identifier}) end
  if pandoc.Figure then return pandoc.Figure({pandoc.Plain(images)}, {long = {pandoc.Plain(caption)}}, {block.identifier}) end
  if #paths == 1 then
    images[1].title, images[1].identifier = "fig:", block.identifier
    return pandoc.Para(images)
  end
  if not is_latex then return pandoc.Div({pandoc.Para(images), pandoc.Para(caption)}, {block.identifier, {"figure"}}) end
  local function raw(text) return pandoc.RawInline("latex", text) end
  images:insert(1, raw("\\begin{figure}\n\\centering\n"))
  images:insert(raw("\n\\caption{"))
  images:extend(caption)
  images:insert(raw("}\\label{" .. block.identifier .. "}\n\\end{figure}"))
  return pandoc.Para(images)
end

--- Returns "scan.md:12" for a line of a text of the document, which is searched from the last find on.
local function place(text, line)
  local name = document
  for _, source in ipairs(sources) do
    local first = source.text:find(text, source.from, true) or source.text:find(text, 1, true)
    if first then
      source.from = first + 1
      return source.name .. ":" .. select(2, source.text:sub(1, first - 1):gsub("\n", "")) + 1 + (line or 0)
    end
  end
  local top = text:match("^%s*([^\n]+)\n")
  return top and place(top, line) or document
end

--- Returns work(), or nil and the message of a failure with its place, if failures are shown; else ends Pandoc.
local function attempt(element, work)
  local here = place(element.text, 0)
  local ok, result = pcall(work)
  if ok then return result end
  if type(result) ~= "table" then error(result, 0) end
  local file, first = here:match("^(.*):(%d+)$")
  local message = (file and file .. ":" .. math.tointeger(first) + (result.line or 0) or here) .. ": " .. result.message
  if (element.attributes.errors or settings.errors) == "show" then return nil, message end
  io.stderr:write("meshfolio: ", message, "\n")
  os.exit(83)
end

local function error_box(message)
  local text = pandoc.Strong{pandoc.Str(message)}
  local lines = pandoc.Para(is_latex and {pandoc.RawInline("latex", "{\\color{red}"), text, pandoc.RawInline("latex", "}")} or {text})
  return pandoc.Div({lines}, {"", {"meshfolio-error"}, {style = "border: 2px solid #b00020; color: #b00020; padding: 0.3em 0.8em"}})
end

local function block_of(block)
  local options, blocks, pictures, echo = block.attributes, pandoc.List(), {}, {}
  local caption = pandoc.utils.blocks_to_inlines(pandoc.read(options.caption or "", "markdown").blocks)
  for _, command in ipairs(commands_of(block.text)) do
    local stem = block.identifier ~= "" and block.identifier:gsub("[^%w_-]", "-") .. (#pictures > 0 and "-" .. #pictures + 1 or "")
    local ok, printed, outputs = pcall(run, command, stem)
    if not ok then
      if type(printed) == "table" then printed.line = printed.line or command.line end
      error(printed, 0)
    end
    table.insert(echo, "meshfolio " .. command.text)
    local seen = #pictures
    for _, path in ipairs(outputs) do
      printed = ("\n" .. printed):gsub("\n" .. path:gsub("%p", "%%%0") .. "\n", "\n"):gsub("^\n", "")
      if path:match("%.png$") or path:match("%.svg$") or path:match("%.pdf$") then table.insert(pictures, path) end
    end
    local last = printed:match("([^\n]+)\n$")
    if last and last:match("%.[ps][nvd][gf]$") and contents(last) then
      table.insert(pictures, last)
    else
      blocks:extend(blocks_of(printed, options))
    end
  end
  if #pictures > 0 then
    blocks:insert(figure_of(pictures, block, caption))
  elseif #blocks > 0 and blocks[1].t == "Table" then
    if quarto then blocks:insert(pandoc.Para(caption)) else blocks[1].caption.long = {pandoc.Plain(caption)} end
    blocks = {pandoc.Div(blocks, {block.identifier})}
  end
  if (options.echo or tostring(settings.echo)) == "true" then table.insert(blocks, 1, pandoc.CodeBlock(table.concat(echo, "\n"), {"", {"sh"}})) end
  return blocks
end

local function CodeBlock(block)
  if not block.classes:includes("meshfolio") then return nil end
  local blocks, message = attempt(block, function() return block_of(block) end)
  return blocks or error_box(message)
end

local function Code(code)
  if not code.classes:includes("meshfolio") then return nil end
  local inlines, message = attempt(code, function()
    local commands = commands_of(code.text)
    local printed = #commands == 1 and run(commands[1]) or refuse("write one command here")
    return inlines_of(printed:gsub("%s+$", ""), code.attributes.digits)
  end)
  return inlines or pandoc.Strong{pandoc.Str(message)}
end

local function Meta(meta)
  local given = meta.meshfolio or {}
  for name, value in pairs(given) do
    if name == "meshes" then
      for mesh, list in pairs(value) do settings.meshes[mesh] = commands_of(stringify(list))[1] end
    elseif not has(FILTER_KEYS, name) then
      table.insert(settings.render, {name = name, word = "--" .. name .. (value == true and "" or "=" .. stringify(value))})
    end
  end
  table.sort(settings.render, function(a, b) return a.name < b.name end)
  if given.size then table.insert(settings.render, {name = "dpi", word = "--dpi=" .. math.floor(tonumber(stringify(given.size)) * 25.4 / 85)}) end
  settings.echo, settings.anywhere = given.echo, given["allow-outside"] == true
  settings.errors = given.errors and stringify(given.errors)
  local data = meta.data or given.data
  if data then settings.data = meta.data and stringify(data) or below(folder, stringify(data)) end
  settings.folders = settings.data and {files, settings.data, folder} or {files, folder}
  for _, name in ipairs(quarto and {document} or PANDOC_STATE.input_files) do
    table.insert(sources, {name = name, text = (contents(name) or ""):gsub("\r\n", "\n"), from = 1})
  end
end

return {{Meta = Meta}, {traverse = "topdown", CodeBlock = CodeBlock, Code = Code}}
