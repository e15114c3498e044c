// cli/signals.h: handles ctrl-C, terminated sessions and closed pipes.
#pragma once

#include "engine/base/monitor.h"

namespace sikku {

/// SIGINT, SIGTERM or SIGHUP arrived.
class Interrupted : public Stopped {
    using Stopped::Stopped;
};

/// Handles signals. Call once, first. The first SIGINT, SIGTERM or SIGHUP asks the work to stop; the program ends
/// half a second later if the work continues, or at once on a second signal. Temporary files are removed. Signals
/// ignored at program start (nohup, background jobs of a script) stay ignored.
void catch_signals();

/// True if work should stop.
bool interrupted();

/// Exit status after an interruption: 128 plus the signal number. Call before reporting it: a slow exit afterwards is
/// still cut short, but without a second message.
int interruption_status();

/// Makes writing to a closed pipe an error instead of ending the program.
void ignore_closed_pipes();

/// Makes ctrl-Z (SIGTSTP) ask for a pause.
void catch_pause();
/// True after ctrl-Z.
bool pause_wanted();
/// Stops the process as ctrl-Z does; returns when it is continued (fg).
void pause_now();

/// Monitor for library work: stops when interrupted() does.
inline Monitor stop_monitor() {
    return Monitor([](void*) { return interrupted(); });
}

}  // namespace sikku
