/// @file
/// The errors meshfolio raises on purpose. Each knows the exit code of its kind and prints as one line,
///   FILE:LINE: what is wrong; what to do
/// with the parts that apply. Whoever catches one prints `what()` behind "meshfolio: ".
#pragma once

#include <stdexcept>
#include <string>

namespace meshfolio {

/// Exit codes of the program; scripts rely on them.
enum class ExitCode : int {
    ok = 0,
    failed = 1,   // a question or a check failed; the report is there and says so
    usage = 2,    // wrong command line or settings
    input = 3,    // an input file is missing or unusable
    output = 4,   // an output cannot be written
    engine = 5,   // a required engine (PDF) is missing
    interrupted = 130,
};

/// Where in an input something was found.
struct Location {
    std::string file;   // empty: no file
    long line = 0;      // counted from 1; 0: the file as a whole
};

class Error : public std::runtime_error {
public:
    ExitCode exit_code() const { return exit_code_; }

protected:
    Error(ExitCode code, const Location& where, const std::string& problem, const std::string& remedy);

private:
    ExitCode exit_code_;
};

/// The command line or a settings file asks for something that does not exist or makes no sense.
class UsageError : public Error {
public:
    explicit UsageError(const std::string& problem, const std::string& remedy = "", const Location& where = {})
        : Error(ExitCode::usage, where, problem, remedy) {}
};

/// An input file is missing, unreadable or not what it claims to be.
class InputError : public Error {
public:
    explicit InputError(const Location& where, const std::string& problem, const std::string& remedy = "")
        : Error(ExitCode::input, where, problem, remedy) {}
};

/// A mesh was read but cannot serve for what is asked of it, or a function was given sizes that do not fit together.
class MeshError : public Error {
public:
    explicit MeshError(const std::string& problem, const std::string& remedy = "", const Location& where = {})
        : Error(ExitCode::input, where, problem, remedy) {}
};

/// A factorisation or an eigensolver did not deliver.
class SolverError : public Error {
public:
    explicit SolverError(const std::string& problem, const std::string& remedy = "") : Error(ExitCode::failed, {}, problem, remedy) {}
};

/// A file or folder cannot be written.
class OutputError : public Error {
public:
    explicit OutputError(const std::string& path, const std::string& problem, const std::string& remedy = "")
        : Error(ExitCode::output, {path, 0}, problem, remedy) {}
};

/// Whoever read the pipe that is written to has closed it. Nothing failed, but nothing more is wanted.
class ReaderGone : public OutputError {
public:
    using OutputError::OutputError;
};

/// A program that was required (a PDF engine, say) is not on this machine.
class EngineError : public Error {
public:
    explicit EngineError(const std::string& problem, const std::string& remedy = "") : Error(ExitCode::engine, {}, problem, remedy) {}
};

/// Bytes from outside made harmless for one line of a terminal: control characters, lone surrogates, bidirectional
/// overrides and bytes that are not UTF-8 become visible escapes such as \x1b.
std::string printable(const std::string& text);

}   // namespace meshfolio
