// tests/fuzz/gallery_jsonl_fuzz.cpp: manifests of any bytes, up to the list of jobs.
#include "tests/fuzz/gallery_targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    sikku::try_gallery_jsonl({reinterpret_cast<const char*>(data), size});
    return 0;
}
