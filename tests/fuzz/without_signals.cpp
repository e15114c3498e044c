// tests/fuzz/without_signals.cpp: the parts of the program run without main() and its signal handlers.
#include "cli/command.h"

namespace sikku {

[[gnu::weak]] bool interrupted() {
    return false;
}

}  // namespace sikku
