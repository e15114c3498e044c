// cli/live.h: `sikku play --port`: music on a MIDI port, in time.
#pragma once

#include "engine/base/monitor.h"
#include "music/note_stream.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace sikku {

/// The options of live music.
struct LiveOptions {
    std::string port;
    std::vector<std::string> repeat;  ///< optionally with a number
    CLI::Option* repeat_option = nullptr;
    std::string clock;
};

void add_live_options(CLI::App& command, LiveOptions& options);

/// True if music is sent to a port. @throws UsageError for options that need one, or cannot be combined
/// @param output  file of `-o`, or empty
bool is_live(const LiveOptions& options, const std::string& output);

/// The score that is played, read again after each change of a file.
struct LiveScore {
    std::function<std::unique_ptr<NoteStream>(const Monitor& monitor)> open;
    std::function<std::vector<std::filesystem::path>()> files;  ///< files whose changes are heard
};

/// Plays to the port until the end, or until it is interrupted. @throws exceptions of LiveScore; PortError; Stopped
void play_live(const LiveOptions& options, const LiveScore& score, bool quiet);

}  // namespace sikku
