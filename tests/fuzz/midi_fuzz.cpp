// tests/fuzz/midi_fuzz.cpp: MIDI files: what is wrong with them, and what they were made from.
#include "tests/fuzz/file_targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    sikku::try_midi({reinterpret_cast<const char*>(data), size});
    return 0;
}
