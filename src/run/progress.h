/// @file
/// What a long command is doing, on stderr: a bar on a terminal, a line for each part that is done elsewhere.
#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <string_view>

namespace meshfolio::run {

/// Thread-safe; never throws.
class ProgressDisplay {
public:
    /// @param terminal  draw a bar, at most ten times a second
    /// @param expected  seconds the whole will take; 0: not known before something is done
    explicit ProgressDisplay(bool terminal, double expected = 0);
    ~ProgressDisplay();   // leaves a clean line
    ProgressDisplay(const ProgressDisplay&) = delete;
    ProgressDisplay& operator=(const ProgressDisplay&) = delete;

    /// `fraction` of the whole that is done, in [0, 1].
    void advance(double fraction);
    /// What is being done now, "q4: eigenpairs of armadillo"; only seen on a terminal.
    void step(std::string_view what);
    /// Something that is done: a line of its own where there is no terminal.
    void milestone(std::string_view what);
    /// ", about 40 s left"; empty where that is not known. See seconds_left().
    std::string left() const;

private:
    using Clock = std::chrono::steady_clock;
    const bool terminal_;
    const double expected_;
    const Clock::time_point begun_ = Clock::now();
    mutable std::mutex mutex_;
    double fraction_ = 0;
    std::string step_;
    Clock::time_point drawn_at_{};
    bool drawn_ = false;
    void draw(bool now);
    std::string left_unlocked() const;
};

/// Remaining seconds at a share done: first from the estimate, later more and more from the time taken. Without an estimate (0), from the
/// time taken alone; 0 where nothing is done.
double seconds_left(double expected, double taken, double fraction);

/// "40 s", "12 min", "3.5 h".
std::string time_text(double seconds);

/// What a command works on while the object lives. On a terminal, a command that runs for more than two seconds shows its innermost stage
/// on stderr with the seconds it has taken: "inspect: reading bunny.off, 12 s". Elsewhere, and beside a ProgressDisplay, nothing is shown.
/// Stages are nested and belong to one thread; advance() may be called from any.
class Stage {
public:
    explicit Stage(const std::string& what);
    ~Stage();
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

    /// The share that is done, in [0, 1], where it is known.
    void advance(double fraction);

private:
    std::size_t depth_;
};

/// "inspect: reading bunny.off, 45 %, 12 s", shortened to `width` columns; no share where `fraction` is negative.
std::string stage_line(std::string_view what, double fraction, int seconds, int width);

/// Erases the stage line on the terminal, before other text is written.
void make_room_on_terminal();

/// "[#########···········]  45 %  q4: 150 eigenpairs", shortened to `width` columns (counted in code points).
std::string progress_line(double fraction, std::string_view step, int width);

/// True when stderr is a terminal that can redraw a line.
bool stderr_is_terminal();

}   // namespace meshfolio::run
