/// @file
/// src.txt: the project's own source in one text with numbered lines. It begins with an index from questions to lines; the files that the
/// answers are computed by come first.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "report/document.h"

namespace meshfolio::submission {

struct SourceFile {
    std::string path;         // "src/main.cpp"
    std::string_view bytes;   // compiled in
};

/// Returns every file of the source tree that git holds, compiled in, sorted by path: also meshes and pictures.
std::vector<SourceFile> source_tree();

/// Returns the words of `build_packages` in tests/setup.sh: the Debian packages that the build needs.
/// @throws std::logic_error if `setup_script` has no such list
std::vector<std::string> build_packages(std::string_view setup_script);

/// Returns the line, counted from 1, that defines the function or class `name` at namespace scope; 0: no line. Calls, declarations and
/// comments do not count. The text must be formatted: a definition begins in the first column.
/// Of overloads the first counts. "Type::member" finds a member defined outside its class. A bare name finds a member too if no function or
/// class has that name alone: "SparseFactor" may be the constructor SparseFactor::SparseFactor.
long definition_line(std::string_view cpp, std::string_view name);

// ---- the order -------------------------------------------------------------------------------------------------------------

/// Returns the paths of the files that compute the answers: the questions' chapters, then the modules of the mathematics, the meshes and
/// the studies that they cite or include, then the modules that these include, and so on. A module (a header and its implementation) that
/// would exceed `most_lines` in all is left out; each file counts `lines_a_file` lines more than it has.
std::set<std::string> answering_files(const std::vector<SourceFile>& files, const std::vector<std::string>& cited, int most_lines,
                                      int lines_a_file);

/// A part of the listing, such as "The questions".
struct ReadingPart {
    std::string_view title;
    bool answers;                               // it holds files that compute the answers
    std::vector<std::string_view> beginnings;   // of paths; a file belongs to the first part with a beginning of its path
};
/// Returns all parts in the order of the listing.
const std::vector<ReadingPart>& reading_parts();

/// The place of a file in the listing: sorted by part, then by module, a header before its implementation.
struct ReadingPlace {
    std::size_t part = 0;
    std::string module;   // path without its ending
    bool is_implementation = false;
    auto operator<=>(const ReadingPlace&) const = default;
};
/// Returns the place of a file in the listing. @param answers  it is one of answering_files()
ReadingPlace reading_place(const std::string& path, bool answers);

// ---- the text --------------------------------------------------------------------------------------------------------------

/// A section of the report and the code it cites, for the index.
struct CitingSection {
    std::string label;   // "Q1", "A"
    std::string title;
    std::vector<report::CodeReference> code;
};

class SourceListing {
public:
    /// Lists the source with numbered lines, and enters the line of each citation of `index`. @param title  the first line
    /// @param files  the source tree; only files for which is_source(path) is true are listed
    SourceListing(const std::string& title, const std::vector<SourceFile>& files, std::vector<CitingSection> index);

    /// Returns the text of src.txt. Lines end in LF; each begins with its number, six wide, and two blanks.
    const std::string& text() const { return text_; }

    /// Returns the line of text() that defines a function or a class of the file; 0: it is not defined there.
    int line_of(const std::string& function, const std::string& file) const;

    const std::vector<CitingSection>& index() const { return index_; }   // with lines

    /// The most lines of the index and the answering files together.
    static constexpr int most_answer_lines = 15'000;

    /// True for C++ files of the program and its renderer; all other files are in the source archive alone.
    static bool is_source(std::string_view path);

private:
    struct Listed {
        SourceFile file;
        ReadingPlace place;
        int lines = 0, first = 0;
    };
    std::vector<Listed> files_;
    std::vector<CitingSection> index_;
    std::string text_;

    std::vector<std::string> head(const std::string& title) const;
};

/// Enters the line of every cited function and class. A citation that is not found keeps line 0 and adds a warning to its section.
/// @return  one sentence for each citation that is not found
std::vector<std::string> cite(report::Document& document, const SourceListing& listing);

}   // namespace meshfolio::submission
