// tests/works.h: works made in memory, and errors with the exit status that the program gives them.
#pragma once

#include "engine/base/toml_file.h"
#include "engine/derivation/derivation.h"
#include "engine/interpreter.h"
#include "music/score/score.h"
#include "tests/checks.h"

#include <map>
#include <ostream>
#include <string>
#include <utility>

namespace sikku {

/// Result of a work.
struct MadeWork {
    int status = 0;     ///< exit status of the program: 2 for usage errors and invalid patterns, 1 for other failures
    std::string error;  ///< the message, if the work failed
    std::string remarks;  ///< a line each; warnings begin with `warning: `
    std::map<std::string, std::string> outputs;
    /// The bytes of the first output. @throws std::runtime_error if the work failed
    const std::string& bytes() const {
        if (outputs.empty()) throw std::runtime_error(error);
        return outputs.begin()->second;
    }
};

inline std::string remarks_of(const Made& made) {
    std::string text;
    for (const Remark& remark : made.remarks) text += (remark.is_warning ? "warning: " : "") + remark.text + "\n";
    return text;
}

/// The warnings, one per line.
inline std::string warnings_of(const Made& made) {
    std::string text;
    for (const Remark& remark : made.remarks) text += remark.is_warning ? remark.text + "\n" : "";
    return text;
}

/// Makes a document in a format and keeps only the remarks. Names in `values` are options of the interpreter,
/// or keys and defines of the pattern. @throws as assign(), plan() and make()
inline Made remarks_about(const Interpreter& interpreter, const Document& document, const std::string& format,
                          const OptionValues& values = {}) {
    MemoryDestination memory;
    const Assignment assigned = assign(interpreter, document, values);
    return interpreter.plan(assigned.document, format, assigned.options)->make(memory, "x." + format, {});
}

/// Calls `plan(memory)`, which makes a work in memory and returns what it made. After an error no output is kept.
template <typename Plan>
MadeWork made_work(Plan&& plan) {
    MadeWork result;
    MemoryDestination memory;
    try {
        result.remarks = remarks_of(std::forward<Plan>(plan)(memory));
    } catch (const std::exception& error) {
        const bool is_usage = dynamic_cast<const PatternError*>(&error) || dynamic_cast<const WordError*>(&error) ||
                              dynamic_cast<const SettingError*>(&error) || dynamic_cast<const FileError*>(&error) ||
                              dynamic_cast<const ScoreError*>(&error);
        result.status = is_usage ? 2 : 1;
        result.error = error.what();
        EXPECT_TRUE(memory.outputs().empty()) << result.error;
    }
    result.outputs = memory.outputs();
    return result;
}

/// Makes a document in a format. Names in `values` are options of the interpreter, or keys and defines of the
/// pattern.
inline MadeWork made_work(const Interpreter& interpreter, const Document& document, const std::string& format,
                          const OptionValues& values = {}) {
    return made_work([&](MemoryDestination& memory) {
        const Assignment assigned = assign(interpreter, document, values);
        return interpreter.plan(assigned.document, format, assigned.options)->make(memory, "x." + format, {});
    });
}

/// Checks that it is rejected with this status and this part of a message.
inline ::testing::AssertionResult is_refused(const MadeWork& work, int status, std::string_view part) {
    if (work.status == status) return has(work.error, part);
    return ::testing::AssertionFailure() << "status " << work.status << ", not " << status << ": " << work.error;
}

}  // namespace sikku
