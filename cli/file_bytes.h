// cli/file_bytes.h: music and pages into a file that appears whole or not at all.
#pragma once

#include "engine/base/output_file.h"
#include "music/score/score.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace sikku {

/// What a pipe gets waits for finish(), as a pipe cannot go back.
class FileBytes : public ByteSink {
public:
    explicit FileBytes(OutputFile& file) : file_(file) {}
    void write(std::string_view bytes) override {
        if (file_.can_insert()) {
            file_.write(bytes);
        } else {
            waiting_ += bytes;  // a pipe cannot go back
        }
    }
    void overwrite(std::uint64_t position, std::string_view bytes) override {
        if (file_.can_insert()) {
            file_.overwrite(position, bytes);
        } else {
            waiting_.replace(position, bytes.size(), bytes);
        }
    }
    void finish() {
        if (!waiting_.empty()) file_.write(waiting_);
    }

private:
    OutputFile& file_;
    std::string waiting_;
};

}  // namespace sikku
