#include "report/pdf/spawn.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <unistd.h>

extern char** environ;

namespace meshfolio::report {

namespace {

/// As `environ`, with what is to take its place.
std::vector<std::string> environment_with(const std::map<std::string, std::string>& changes) {
    std::vector<std::string> words;
    for (char** entry = environ; *entry != nullptr; ++entry) {
        const std::string word = *entry;
        if (!changes.contains(word.substr(0, word.find('=')))) words.push_back(word);
    }
    for (const auto& [name, value] : changes) words.push_back(name + "=" + value);
    return words;
}

std::vector<char*> pointers_to(std::vector<std::string>& words) {
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    return pointers;
}

struct SpawnRules {
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;

    SpawnRules(const ChildTask& task, int output, int channel) {
        posix_spawn_file_actions_init(&files);
        posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_adddup2(&files, output, STDOUT_FILENO);
        posix_spawn_file_actions_adddup2(&files, output, STDERR_FILENO);
        for (const int number : {3, 4})
            if (channel >= 0) posix_spawn_file_actions_adddup2(&files, channel, number);
        posix_spawn_file_actions_addchdir_np(&files, task.folder.c_str());
        posix_spawnattr_init(&attributes);
        sigset_t none, all;
        sigemptyset(&none);
        sigfillset(&all);
        posix_spawnattr_setsigmask(&attributes, &none);
        posix_spawnattr_setsigdefault(&attributes, &all);
        posix_spawnattr_setpgroup(&attributes, 0);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    }
    ~SpawnRules() {
        posix_spawn_file_actions_destroy(&files);
        posix_spawnattr_destroy(&attributes);
    }
    SpawnRules(const SpawnRules&) = delete;
    SpawnRules& operator=(const SpawnRules&) = delete;
};

}   // namespace

int spawn(const ChildTask& task, int output, int channel, pid_t& process) {
    std::vector<std::string> words{task.program.string()};
    words.insert(words.end(), task.arguments.begin(), task.arguments.end());
    std::vector<std::string> environment = environment_with(task.environment);
    const SpawnRules rules(task, output, channel);
    return ::posix_spawn(&process, task.program.c_str(), &rules.files, &rules.attributes, pointers_to(words).data(),
                         pointers_to(environment).data());
}

}   // namespace meshfolio::report
