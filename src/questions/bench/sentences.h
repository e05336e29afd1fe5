/// @file
/// Joins sentences to paragraphs. An empty sentence stands for one that does not apply.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "questions/core/section_tools.h"

namespace meshfolio {

/// Joins sentences by spaces; an empty one is left out.
inline report::Text paragraph_of(std::initializer_list<report::Text> sentences) {
    report::Text paragraph;
    for (const report::Text& sentence : sentences) {
        if (sentence.empty()) continue;
        if (!paragraph.empty()) report::extend(paragraph, " ");
        report::extend(paragraph, sentence);
    }
    return paragraph;
}

/// Appends a space and a sentence.
inline void go_on(report::Text& text, const report::Text& sentence) { report::extend(text, " ", sentence); }

/// What the message says of these {{meshes}}; nothing where there are none.
inline report::Text said_of(const std::vector<std::string>& meshes, const report::Words& words, std::string_view key) {
    return meshes.empty() ? report::Text() : words.say(key, "meshes"_a = listed(meshes));
}
inline report::Text said_of(const std::vector<Observed>& meshes, const report::Words& words, std::string_view key) {
    return meshes.empty() ? report::Text() : words.say(key, "meshes"_a = listed_observed(meshes));
}

}   // namespace meshfolio
