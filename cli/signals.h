// cli/signals.h: what ctrl-C, a terminated session and a closed pipe do to the program.
#pragma once

#include "engine/monitor.h"

namespace sikku {

/// SIGINT, SIGTERM or SIGHUP arrived.
class Interrupted : public Stopped {
    using Stopped::Stopped;
};

/// To be called once, first. The first SIGINT, SIGTERM or SIGHUP asks the work to stop; work that goes on half a
/// second later is ended, as it is at once by a second signal. No temporary file stays behind. Signals that are
/// ignored when the program starts (nohup, jobs in the background of a script) stay ignored.
void catch_signals();

/// Whether the work is to stop.
bool interrupted();

/// Exit status after an interruption: 128 and the number of the signal.
int interruption_status();

/// For work of the libraries: stops when interrupted() does.
inline Monitor stop_monitor() {
    return Monitor([](void*) { return interrupted(); });
}

}  // namespace sikku
