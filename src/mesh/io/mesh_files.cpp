#include "mesh/io/mesh_files.h"

#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/gunzipped.h"
#include "base/lower_case.h"
#include "mesh/io/text_scanner.h"

namespace meshfolio {

namespace {

struct Format {
    std::string_view ending;
    std::string_view name;
    LoadedMesh (*parse)(std::string_view bytes, const std::string& file, Keep keep);
};

constexpr Format formats[] = {
    {".obj", "OBJ", parse_obj}, {".off", "OFF", parse_off}, {".ply", "PLY", parse_ply},
    {".stl", "STL", parse_stl}, {".vtp", "VTP", parse_vtp}, {".glb", "GLB", parse_glb},
};

/// The first bytes of files that sometimes have the name of a mesh.
struct Signature {
    std::string_view begin, name, remedy;
};

using namespace std::string_view_literals;

constexpr const char* other_remedy = "convert it to OBJ, OFF, PLY, STL, VTP or GLB";

constexpr Signature signatures[] = {
    {"PK\x03\x04"sv, "ZIP archive, not a mesh"sv, "unpack it first"sv},
    {"\x1f\x8b"sv, "gzip data within gzip data"sv, "unpack it with gunzip first"sv},
    {"BZh"sv, "bzip2 data, not a mesh"sv, "unpack it first"sv},
    {"\3757zXZ"sv, "xz data, not a mesh"sv, "unpack it first"sv},
    {"7z\xbc\xaf"sv, "7-Zip archive, not a mesh"sv, "unpack it first"sv},
    {"\x28\xb5\x2f\xfd"sv, "zstd data, not a mesh"sv, "unpack it first"sv},
    {"version https://git-lfs"sv, "Git LFS pointer, not the mesh itself"sv, "run 'git lfs pull'"sv},
    {"\xff\xfe"sv, "UTF-16 text"sv, "save it as UTF-8 or ASCII"sv},
    {"\xfe\xff"sv, "UTF-16 text"sv, "save it as UTF-8 or ASCII"sv},
    {"%PDF"sv, "PDF document, not a mesh"sv, "name the mesh file"sv},
    {"\x89PNG"sv, "PNG picture, not a mesh"sv, "name the mesh file"sv},
    {"Kaydara FBX"sv, "FBX, which is not supported"sv, other_remedy},
};

/// Returns the ending, such as ".ply", of the format that begins like these bytes; empty if it could be any.
std::string_view ending_of_content(std::string_view bytes) {
    if (bytes.starts_with("glTF")) return ".glb";
    const std::string_view start = without_bom(bytes).substr(0, 4096);
    LineScanner lines(start);
    if (start.substr(0, 1024).find("<VTKFile") != std::string_view::npos) return ".vtp";
    const bool binary = start.find('\0') != std::string_view::npos && !start.starts_with("ply");
    if (binary || !lines.next_with_words()) return {};
    std::string_view line = lines.line();
    const std::string_view word = take_word(line);
    const bool off_keyword = word.ends_with("OFF") && word.find_first_not_of("STCN4nOF") == std::string_view::npos;
    if (off_keyword) return ".off";
    if (word == "ply") return ".ply";
    for (const char* keyword : {"v", "vn", "vt", "mtllib", "usemtl", "o", "g"})
        if (word == keyword) return ".obj";
    return same_but_for_case(word, "solid") ? ".stl" : "";
}

/// Checks the first bytes of a file. @throws InputError if they are no mesh in a format that is read
void refuse_other_content(std::string_view bytes, const std::string& file) {
    for (const Signature& s : signatures)
        if (bytes.starts_with(s.begin)) throw InputError({file, 0}, std::string(s.name), std::string(s.remedy));
    const std::string text = lower_case(std::string(without_leading_space(without_bom(bytes).substr(0, 256)).substr(0, 16)));
    for (const char* tag : {"<!doctype", "<html", "<head", "<body"})
        if (text.starts_with(tag))
            throw InputError({file, 0}, "HTML page, not a mesh", "the download may have failed; fetch the file itself");
    if (text.starts_with("<") && ending_of_content(bytes) != ".vtp") throw InputError({file, 0}, "XML text, not a mesh", other_remedy);
}

std::filesystem::path without_gz(const std::filesystem::path& file) {
    return lower_case_ending(file) == ".gz" ? file.parent_path() / file.stem() : file;
}

/// Returns the format with this ending, such as ".ply", or null.
const Format* format_of(std::string_view ending) {
    const auto format = std::ranges::find(formats, ending, &Format::ending);
    return format == std::end(formats) ? nullptr : format;
}

}   // namespace

std::string mesh_name(const std::string& file) { return without_gz(file).stem().string(); }

bool is_mesh_file(const std::string& file) { return format_of(lower_case_ending(without_gz(file))) != nullptr; }

std::vector<std::string> mesh_endings() {
    std::vector<std::string> endings;
    for (const Format& format : formats) endings.emplace_back(format.ending);
    return endings;
}

std::vector<std::string> column_endings() { return {".ply", ".vtp", ".glb"}; }

LoadedMesh parse_mesh(std::string_view bytes, const std::string& file, Keep keep) {
    if (bytes.empty()) throw InputError({file, 0}, "file is empty", "export or download the mesh again");
    std::string unpacked;
    if (is_gzip(bytes)) bytes = unpacked = gunzipped(bytes, file);
    const std::string_view content = ending_of_content(bytes);
    std::string ending = lower_case_ending(without_gz(file));
    if (file == standard_input) ending = !content.empty() ? content : bytes.find('\0') == std::string_view::npos ? ".obj" : ".stl";
    const Format *const format = format_of(ending), *const other = format_of(content);
    if (format == nullptr)
        throw InputError({file, 0}, "unknown mesh format '" + ending + "'", "meshes end in .obj, .off, .ply, .stl, .vtp or .glb");
    refuse_other_content(bytes, file);
    if (other != nullptr && other != format)
        throw InputError({file, 0}, "looks like " + std::string(other->name) + ", but the name says " + ending,
                         "rename it to end in " + std::string(content));
    return format->parse(bytes, file, keep);
}

LoadedMesh read_mesh(const std::filesystem::path& path, Keep keep) { return parse_mesh(read_file(path), path.string(), keep); }

}   // namespace meshfolio
