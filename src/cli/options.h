/// @file
/// The options of a command. CLI11, whose headers take seconds to compile, is included by cli.cpp alone.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace meshfolio::cli {

/// Puts what follows a command into variables of its own, which must outlive the parsing. Names are CLI11's: "MESH" is a place,
/// "-o,--output" an option. A variable that is not empty keeps its value as the default, which the help shows.
class CommandOptions {
public:
    CommandOptions(CLI::App& parent, const std::string& command, const std::string& purpose);

    void text(const std::string& names, std::string& value, const std::string& help);
    void required(const std::string& names, std::string& value, const std::string& help);
    void choice(const std::string& names, std::string& value, const std::vector<std::string>& choices, const std::string& help);
    /// A place takes all that follows, an option one word each time.
    void texts(const std::string& names, std::vector<std::string>& values, const std::string& help);
    void flag(const std::string& names, bool& value, const std::string& help);
    /// What the help ends with: an example.
    void footer(const std::string& text);

    operator CLI::App*() const { return app_; }

private:
    CLI::App* app_;
};

}   // namespace meshfolio::cli
