/// @file
/// Checks of a reader: the place and message of its error, its warnings, and the tetrahedron that it has read.
#pragma once

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "base/errors.h"
#include "mesh/io/mesh_files.h"
#include "mesh/small_meshes.h"

namespace meshfolio::testing {

/// Returns the text with the first `from` replaced by `to`. @throws std::invalid_argument if there is none
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    if (at == std::string::npos) throw std::invalid_argument(from);
    return text.replace(at, from.size(), to);
}

/// Returns the message of the error for `bytes`, or "accepted" if there is none.
inline std::string refusal(const std::string& bytes, const std::string& file) {
    try {
        parse_mesh(bytes, file);
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

/// Passes if the message begins with `place` ("m.obj:4"), contains `text`, and has a remedy behind a semicolon.
inline ::testing::AssertionResult refused(const std::string& bytes, const std::string& place, const std::string& text) {
    const std::string file = place.substr(0, place.find(':'));
    const std::string message = refusal(bytes, file);
    const bool remedy = message.find("; ") != std::string::npos;
    if (message.starts_with(place + ": ") && message.find(text) != std::string::npos && remedy) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << "said: " << message;
}

/// Returns the warnings as lines of "line: message".
inline std::string warnings_of(const LoadedMesh& loaded) {
    std::string all;
    for (const MeshWarning& warning : loaded.warnings) all += std::to_string(warning.line) + ": " + warning.message + "\n";
    return all;
}

/// Expects the tetrahedron, with these warnings. @param text  the input, for messages
inline void expect_tetrahedron(const LoadedMesh& loaded, const std::string& warnings = "", const std::string& text = "") {
    EXPECT_EQ(loaded.mesh.X, tetrahedron().X) << text;
    EXPECT_EQ(loaded.mesh.F, tetrahedron().F) << text;
    EXPECT_EQ(warnings_of(loaded), warnings) << text;
}

}   // namespace meshfolio::testing
