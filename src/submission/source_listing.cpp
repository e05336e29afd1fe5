#include "submission/source_listing.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <stdexcept>

#include "embedded_data.h"
#include "embedded_reports.h"
#include "embedded_source.h"

namespace meshfolio::submission {

namespace {

constexpr int banner_lines = 4;       // a blank line, a rule, the path, a rule
constexpr int most_head_lines = 80;   // without the index of the sections and the lines of the files
const std::string rule(100, '=');

std::vector<std::string_view> lines_of(std::string_view bytes) {
    std::vector<std::string_view> lines;
    while (!bytes.empty()) {
        const std::size_t end = std::min(bytes.find('\n'), bytes.size());
        lines.push_back(bytes.substr(0, end));
        bytes.remove_prefix(std::min(end + 1, bytes.size()));
    }
    return lines;
}

std::string blanks(std::size_t width, std::size_t used) { return std::string(width > used ? width - used : 0, ' '); }
std::string left(const std::string& text, std::size_t width) { return text + blanks(width, text.size()); }
std::string right(int number, std::size_t width) {
    const std::string digits = std::to_string(number);
    return blanks(width, digits.size()) + digits;
}

// ---- definitions -----------------------------------------------------------------------------------------------------------

bool is_name_character(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == ':' || c == '~'; }

/// Returns the name of the type or function that the line begins to define or declare; empty: none. A '=' tells variables apart.
std::string_view name_in(std::string_view line) {
    if (line.empty() || line.starts_with("template") || line.find_first_of(" #}/\"") == 0) return {};
    for (const std::string_view kind : {"class ", "struct ", "union ", "enum class ", "enum "}) {
        if (!line.starts_with(kind)) continue;
        const std::string_view rest = line.substr(kind.size());
        return rest.substr(0, static_cast<std::size_t>(std::ranges::find_if_not(rest, is_name_character) - rest.begin()));
    }
    std::size_t end = 0;   // of the name: the first parenthesis outside angle brackets
    for (int angles = 0; end < line.size() && (line[end] != '(' || angles != 0); ++end)
        angles += line[end] == '<' ? 1 : line[end] == '>' ? -1 : 0;
    if (end == line.size() || line.substr(0, end).find('=') != line.npos) return {};
    std::size_t begin = end;
    while (begin > 0 && is_name_character(line[begin - 1])) --begin;
    return line.substr(begin, end - begin);
}

/// True if a body follows, false if the text ends as a declaration.
bool is_definition(std::string_view text) {
    int parentheses = 0;
    for (const char c : text) {
        parentheses += c == '(' ? 1 : c == ')' ? -1 : 0;
        if (parentheses == 0 && (c == '{' || c == ';')) return c == '{';
    }
    return false;
}

}   // namespace

long definition_line(std::string_view cpp, std::string_view name) {
    long number = 0, line_of_member = 0;
    for (std::string_view rest = cpp; !rest.empty();) {
        const std::string_view line = rest.substr(0, rest.find('\n')), found = name_in(line);
        ++number;
        if (!name.empty() && found.ends_with(name) && is_definition(rest)) {
            if (found.size() == name.size()) return number;
            if (line_of_member == 0 && found.substr(0, found.size() - name.size()).ends_with("::")) line_of_member = number;
        }
        rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    }
    return line_of_member;
}

bool SourceListing::is_source(std::string_view path) {
    return (path.starts_with("src/") || path.starts_with("render/")) && (path.ends_with(".cpp") || path.ends_with(".h"));
}

std::vector<std::string> SourceListing::head(const std::string& title) const {
    std::vector<std::string> lines{
        title,
        "",
        "Every line begins with its number: L420 in the report is line 420 here. Listed is the project's own program, as it was when it",
        "was built: first what the answers are computed by, then the rest of it, and its renderer. Templates, settings, tests and build",
        "files are in the source archive beside it. Nothing of others is in either.",
        "",
        "WHERE EACH QUESTION IS ANSWERED: line, function or class, file, purpose",
    };
    for (const CitingSection& section : index_) {
        lines.push_back("");
        lines.push_back(section.label + "  " + section.title);
        for (const report::CodeReference& code : section.code) {
            const std::string purpose = code.purpose.empty() ? "" : " " + code.purpose;
            lines.push_back("  " + left(code.line > 0 ? "L" + std::to_string(code.line) : "?", 8) + left(code.function, 34) + " " +
                            (purpose.empty() ? code.file : left(code.file, 46) + purpose));
        }
    }
    const auto part_of = [](const Listed& listed) -> const ReadingPart& { return reading_parts().at(listed.place.part); };
    lines.insert(lines.end(), {"", "FILES: first line, number of lines, path; of what the answers do not need, the parts alone"});
    for (std::size_t i = 0; i < files_.size(); ++i) {
        const Listed& listed = files_[i];
        const ReadingPart &part = part_of(listed), *before = i == 0 ? nullptr : &part_of(files_[i - 1]);
        const std::string heading(part.title), line = "  " + left("L" + std::to_string(listed.first), 8);
        if (part.answers) {
            if (before != &part) lines.insert(lines.end(), {"", heading});
            lines.push_back(line + right(listed.lines, 5) + "  " + listed.file.path);
        } else if (before != &part) {
            if (before != nullptr && before->answers) lines.emplace_back();
            lines.push_back(line + heading);
        }
    }
    return lines;
}

SourceListing::SourceListing(const std::string& title, const std::vector<SourceFile>& files, std::vector<CitingSection> index)
    : index_(std::move(index)) {
    std::vector<std::string> cited;   // by questions
    int index_lines = 0;
    for (const CitingSection& section : index_) {
        index_lines += 2 + static_cast<int>(section.code.size());
        for (const report::CodeReference& code : section.code)
            if (section.label.starts_with('Q')) cited.push_back(code.file);
    }
    const std::set<std::string> answering =
        answering_files(files, cited, most_answer_lines - index_lines - most_head_lines, banner_lines + 1);
    for (const SourceFile& file : files) {
        if (!is_source(file.path)) continue;
        files_.push_back({file, reading_place(file.path, answering.contains(file.path)), static_cast<int>(lines_of(file.bytes).size())});
    }
    std::ranges::sort(files_, {}, &Listed::place);

    int line = static_cast<int>(head(title).size());   // its length does not depend on the numbers in it
    for (Listed& listed : files_) {
        listed.first = line + banner_lines + 1;
        line += banner_lines + listed.lines;
    }
    for (CitingSection& section : index_)
        for (report::CodeReference& code : section.code) code.line = line_of(code.function, code.file);

    int number = 0;
    const auto add = [&](std::string_view row) {
        text_ += right(++number, 6) + (row.empty() ? "" : "  ");
        text_ += row;
        text_ += '\n';
    };
    for (const std::string& row : head(title)) add(row);
    for (const Listed& listed : files_) {
        const std::string range = "L" + std::to_string(listed.first) + " to L" + std::to_string(listed.first + listed.lines - 1);
        for (const std::string& row : {std::string(), rule, listed.file.path + "   (" + range + ")", rule}) add(row);
        for (const std::string_view row : lines_of(listed.file.bytes)) add(row);
    }
}

int SourceListing::line_of(const std::string& function, const std::string& file) const {
    const auto listed = std::ranges::find_if(files_, [&](const Listed& l) { return l.file.path == file; });
    if (listed == files_.end()) return 0;
    const long line = definition_line(listed->file.bytes, function);
    return line == 0 ? 0 : listed->first - 1 + static_cast<int>(line);
}

std::vector<std::string> cite(report::Document& document, const SourceListing& listing) {
    std::vector<std::string> missing;
    for (report::Section& section : document.sections) {
        for (report::CodeReference& code : section.code) {
            code.line = listing.line_of(code.function, code.file);
            if (code.line > 0) continue;
            const std::string problem = "cites " + code.function + " of " + code.file + ", which src.txt does not define";
            section.warnings.push_back(problem);
            missing.push_back(section.id + " " + problem);
        }
    }
    return missing;
}

std::vector<SourceFile> source_tree() {
    std::vector<SourceFile> files;
    const auto add = [&](const std::string& folder, const auto& embedded) {
        for (const auto& file : embedded) files.push_back({folder + std::string(file.name), file.bytes});
    };
    add("", meshfolio_embedded::embedded_source());
    add("data/", meshfolio_embedded::embedded_data());
    add("data/reports/", meshfolio_embedded::embedded_reports());
    std::ranges::sort(files, {}, &SourceFile::path);
    return files;
}

std::vector<std::string> build_packages(std::string_view setup_script) {
    constexpr std::string_view opening = "build_packages=\"";
    const std::size_t begin = setup_script.find(opening);
    const std::size_t end = begin == std::string_view::npos ? begin : setup_script.find('"', begin + opening.size());
    if (end == std::string_view::npos) throw std::logic_error("tests/setup.sh has no list build_packages");
    std::istringstream words(std::string(setup_script.substr(begin + opening.size(), end - begin - opening.size())));
    std::vector<std::string> packages;
    for (std::string word; words >> word;) packages.push_back(word);
    return packages;
}

}   // namespace meshfolio::submission
