/// @file
/// src.txt: all source of our own in one text, every line numbered, with an index from questions to lines at its head.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/document.h"
#include "submission/source_tree.h"

namespace meshfolio::submission {

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

    /// Written by hand and to be read: no meshes, pictures, tables of numbers, prose, and nothing made from other files.
    static bool is_source(std::string_view path);

private:
    struct Listed {
        SourceFile file;
        std::size_t part = 0;   // of the listing: questions, geometry, …
        int lines = 0, first = 0;
    };
    std::vector<Listed> files_;
    std::vector<CitingSection> index_;
    std::string text_;

    std::vector<std::string> head(const std::string& title) const;
};

}   // namespace meshfolio::submission
