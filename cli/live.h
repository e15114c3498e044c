// cli/live.h: `sikku play --port`: music on a MIDI port or by OSC messages, in time.
#pragma once

#include "engine/base/monitor.h"
#include "music/note_stream.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
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

/// Changes that messages made to the first pattern.
struct LiveChanges {
    std::optional<std::string> text;            ///< replaces that of the file
    std::map<std::string, std::string> values;  ///< replace those of its keys, and of options
};

/// The score that is played, read again after each change of a file, and after messages with changes.
struct LiveScore {
    std::function<std::unique_ptr<NoteStream>(const LiveChanges& changes, const Monitor& monitor)> open;
    std::function<std::vector<std::filesystem::path>()> files;  ///< files whose changes are heard
};

/// Plays to the port until the end, or until it is interrupted. @throws exceptions of LiveScore; PortError; Stopped
void play_live(const LiveOptions& options, const LiveScore& score, bool quiet);

}  // namespace sikku
