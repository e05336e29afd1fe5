/// @file
/// The errors that meshfolio throws on purpose. Each has the exit code of its kind; its what() is one line,
///   FILE:LINE: problem; remedy
/// without the parts that do not apply. The program prints "meshfolio: " and what().
#pragma once

#include <stdexcept>
#include <string>

namespace meshfolio {

/// Exit codes of the program, on which scripts rely.
enum class ExitCode : int {
    ok = 0,
    failed = 1,   // a question or a check failed; the report exists and says so
    usage = 2,    // wrong command line or settings
    input = 3,    // an input file is missing or unusable
    output = 4,   // an output cannot be written
    engine = 5,   // a required engine (PDF) is missing
    interrupted = 130,
};

/// A place in an input.
struct Location {
    std::string file;   // empty: the error is about no file
    long line = 0;      // from 1; 0: the file as a whole
};

class Error : public std::runtime_error {
public:
    ExitCode exit_code() const { return exit_code_; }

protected:
    Error(ExitCode code, const Location& where, const std::string& problem, const std::string& remedy);

private:
    ExitCode exit_code_;
};

/// The command line or a settings file asks for something that does not exist or is contradictory.
class UsageError : public Error {
public:
    explicit UsageError(const std::string& problem, const std::string& remedy = "", const Location& where = {})
        : Error(ExitCode::usage, where, problem, remedy) {}
};

/// An input file is missing, unreadable or damaged.
class InputError : public Error {
public:
    explicit InputError(const Location& where, const std::string& problem, const std::string& remedy = "")
        : Error(ExitCode::input, where, problem, remedy) {}
};

/// A mesh does not suit the operation, or the sizes of a function's arguments do not match.
class MeshError : public Error {
public:
    explicit MeshError(const std::string& problem, const std::string& remedy = "", const Location& where = {})
        : Error(ExitCode::input, where, problem, remedy) {}
};

/// A factorisation or an eigensolver failed.
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

/// The reader of a pipe has closed it: not a failure, but no more output is wanted.
class ReaderGone : public OutputError {
public:
    using OutputError::OutputError;
};

/// A required program, such as a PDF engine, is not installed.
class EngineError : public Error {
public:
    explicit EngineError(const std::string& problem, const std::string& remedy = "") : Error(ExitCode::engine, {}, problem, remedy) {}
};

/// Returns the text safe for one line of a terminal: control characters, lone surrogates, bidirectional overrides and bytes that are not
/// UTF-8 become escapes such as \x1b.
std::string printable(const std::string& text);

}   // namespace meshfolio
