// tests/fuzz/midi_fuzz.cpp: checks MIDI files and reads the patterns in them.
#include "tests/fuzz/file_targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    sikku::try_midi({reinterpret_cast<const char*>(data), size});
    return 0;
}
