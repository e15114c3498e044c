// studio/editor/message_reader.h: separates the messages of the language server protocol.
// Source: Microsoft, Language Server Protocol 3.17, base protocol.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace sikku {

/// Separates messages. A header with the length in bytes precedes each message.
class MessageReader {
public:
    /// The largest message that is read, in bytes: a document of 64 MB with its escapes. Larger ones are skipped.
    static constexpr std::size_t most_bytes = std::size_t{160} << 20U;

    struct Message {
        std::string content;
        std::size_t size = 0;     ///< bytes that the header states
        bool is_skipped = false;  ///< too large; the content is empty
    };

    /// Adds bytes as they arrive.
    void add(std::string_view bytes);
    /// The next complete message; nullopt if more bytes are needed.
    std::optional<Message> next();
    /// True after an invalid header; the beginning of the next message is then unknown.
    bool is_broken() const { return is_broken_; }

private:
    bool read_header();

    std::string waiting_;                // bytes that belong to no message yet
    std::size_t at_ = 0;                 // offset of the first unread byte
    std::optional<std::size_t> length_;  // of the current message, once its header was read
    std::size_t skipped_ = 0;            // bytes of the current message, if it is too large
    bool is_broken_ = false;
};

/// The message with its header.
std::string with_header(std::string_view message);

}  // namespace sikku
