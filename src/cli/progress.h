/// @file
/// What a long command is doing, on stderr: a bar on a terminal, a line for each part that is done elsewhere.
#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <string_view>

namespace meshfolio::cli {

/// Thread-safe; never throws.
class ProgressDisplay {
public:
    /// @param terminal  draw a bar, at most ten times a second
    explicit ProgressDisplay(bool terminal);
    ~ProgressDisplay();   // leaves a clean line
    ProgressDisplay(const ProgressDisplay&) = delete;
    ProgressDisplay& operator=(const ProgressDisplay&) = delete;

    /// `fraction` of the whole that is done, in [0, 1].
    void advance(double fraction);
    /// What is being done now, "q4: eigenpairs of armadillo"; only seen on a terminal.
    void step(std::string_view what);
    /// Something that is done: a line of its own where there is no terminal.
    void milestone(std::string_view what);

private:
    using Clock = std::chrono::steady_clock;
    const bool terminal_;
    std::mutex mutex_;
    double fraction_ = 0;
    std::string step_;
    Clock::time_point drawn_at_{};
    bool drawn_ = false;
    void draw(bool now);
};

/// "[#########···········]  45 %  q4: 150 eigenpairs", cut to `width` columns (counted in code points).
std::string progress_line(double fraction, std::string_view step, int width);

/// True when stderr is a terminal that can redraw a line.
bool stderr_is_terminal();

}   // namespace meshfolio::cli
