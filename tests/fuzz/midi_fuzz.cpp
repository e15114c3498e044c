// tests/fuzz/midi_fuzz.cpp: checks MIDI files and reads back what they were made from.
#include "tests/fuzz/file_targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    sikku::try_midi({reinterpret_cast<const char*>(data), size});
    return 0;
}
