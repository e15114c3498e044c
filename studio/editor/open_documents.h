// studio/editor/open_documents.h: the documents that an editor has opened.
#pragma once

#include "studio/editor/request_members.h"

#include <cstddef>
#include <map>
#include <string>

namespace sikku {

/// A document that an editor has opened.
struct OpenDocument {
    std::string name;              ///< path of the file, for messages and for files that the pattern names
    std::string text;              ///< empty if it is too large
    std::size_t size = 0;          ///< bytes
    bool is_changed = true;        ///< since its errors were last reported
    bool is_refusal_told = false;  ///< the user was informed that it is too large
    bool is_too_large() const { return size != text.size(); }
};

/// The documents by their addresses. Texts that are too large are not kept.
class OpenDocuments {
public:
    /// The size of the largest text that is kept, in bytes, and of all together.
    static constexpr std::size_t most_bytes = std::size_t{4} << 20U;
    static constexpr std::size_t most_bytes_together = std::size_t{64} << 20U;

    /// Opens a document, or replaces its text.
    void put(const std::string& address, const std::string& text);
    /// Applies changes as the protocol lists them: whole texts, or changed parts. @throws BadRequest
    void change(const std::string& address, const Json& changes);
    /// False if it is not open.
    bool close(const std::string& address);

    /// @throws BadRequest if the document is not open
    const OpenDocument& at(const std::string& address) const;
    std::map<std::string, OpenDocument>& all() { return documents_; }

private:
    std::map<std::string, OpenDocument> documents_;
    std::size_t bytes_ = 0;  // of the texts that are kept
};

/// A message that a document is too large, with the limits and the command that reads it.
std::string too_large_text(const OpenDocument& document);

}  // namespace sikku
