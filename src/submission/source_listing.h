/// @file
/// src.txt: all source of our own in one text, every line numbered, what the answers are computed by first, with an index from questions
/// to lines at its head.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/document.h"
#include "submission/reading_order.h"

namespace meshfolio::submission {

/// All of them, sorted by path: what git holds, meshes and pictures too.
std::vector<SourceFile> source_tree();

/// The words of `build_packages` in tests/setup.sh: the Debian packages that building takes.
/// @throws std::logic_error if `setup_script` has no such list
std::vector<std::string> build_packages(std::string_view setup_script);

/// The line, counted from 1, that holds the name in the definition of a function or a class at namespace scope, as a reader would find it:
/// not a call, a declaration or a comment; 0 if there is none. The text is formatted: such a definition begins in the first column, and
/// nothing else that looks like one does.
/// Of overloads the first counts. "Type::member" asks for a member defined outside its class; a bare name finds one too, when no
/// function or class of that name alone is defined: "SparseFactor" may be the constructor SparseFactor::SparseFactor.
long definition_line(std::string_view cpp, std::string_view name);

/// A section of the report and the code it cites, for the index.
struct CitingSection {
    std::string label;   // "Q1", "A"
    std::string title;
    std::vector<report::CodeReference> code;
};

class SourceListing {
public:
    /// @param title  the first line
    /// @param files  of these, what is_source(path) is listed
    SourceListing(const std::string& title, const std::vector<SourceFile>& files, std::vector<CitingSection> index);

    /// Lines end in LF; each begins with its number, six wide, and two blanks.
    const std::string& text() const { return text_; }

    /// Where in text() the definition of a function or a class of this file stands; 0: nowhere.
    int line_of(const std::string& function, const std::string& file) const;

    const std::vector<CitingSection>& index() const { return index_; }   // with lines

    /// The head and what the answers are computed by are together at most this long: what a marker reads.
    static constexpr int most_answer_lines = 15'000;

    /// Of the program and its renderer. Tests, templates, settings and build files are in the source archive alone.
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

/// Enters the line of every cited function and class. One that is not found keeps line 0 and becomes a warning of its section.
/// @return  those that are not found, as sentences
std::vector<std::string> cite(report::Document& document, const SourceListing& listing);

}   // namespace meshfolio::submission
