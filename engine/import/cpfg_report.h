// engine/import/cpfg_report.h: collects the errors of a cpfg file, and the features lost in its pattern.
#pragma once

#include "engine/import/import.h"

#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace sikku::cpfg {

/// Thrown where a part of the file cannot be imported: a loss drops that part, otherwise the file has an error.
struct Fault {
    std::size_t at;
    std::string message;
    bool is_loss;
};
[[noreturn]] inline void mistake(std::size_t at, std::string message) {
    throw Fault{at, std::move(message), false};
}
[[noreturn]] inline void lose(std::size_t at, std::string message) {
    throw Fault{at, std::move(message), true};
}

inline bool is_blank(char byte) {
    return byte == ' ' || byte == '\t' || byte == '\r' || byte == '\n' || byte == '\f' || byte == '\v';
}
inline bool is_digit(char byte) {
    return byte >= '0' && byte <= '9';
}
inline bool begins_identifier(char byte) {
    return (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z') || byte == '_';
}
inline bool continues_identifier(char byte) {
    return begins_identifier(byte) || is_digit(byte);
}

/// Collects errors and losses of one file.
class Report {
public:
    Report(const SourcePointer& file, Diagnostics& diagnostics)
        : file_(file), diagnostics_(diagnostics), losses_(file, diagnostics) {}

    void error(std::size_t at, const std::string& message) { error(file_, at, message); }
    /// Reports an error of another file.
    void error(const SourcePointer& file, std::size_t at, const std::string& message) {
        diagnostics_.error({file, at, 1}, message);
        failed_ = true;
    }
    void loss(std::size_t at, const std::string& what) { losses_.add(at, what); }
    /// Reports a loss only once for each key.
    void once(const std::string& key, std::size_t at, const std::string& what) {
        if (told_.insert(key).second) losses_.add(at, what);
    }
    bool failed() const { return failed_; }
    ImportLosses& losses() { return losses_; }

private:
    const SourcePointer& file_;
    Diagnostics& diagnostics_;
    ImportLosses losses_;
    bool failed_ = false;
    std::set<std::string> told_;
};

}  // namespace sikku::cpfg
