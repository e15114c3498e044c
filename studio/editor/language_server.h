// studio/editor/language_server.h: a language server that receives and sends messages.
// Source: Microsoft, Language Server Protocol 3.17; JSON-RPC 2.0.
#pragma once

#include "engine/base/monitor.h"
#include "studio/editor/occurrences.h"
#include "studio/editor/request_members.h"
#include "studio/editor/text_edit.h"

#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace sikku {

/// Serves the open documents of an editor: errors while the user types, help, completion, definitions, renaming,
/// formatting, colours, and the sizes of drawings. Not thread-safe. Memory: that of the documents.
class LanguageServer {
public:
    /// Receives an outgoing message: JSON, without its header.
    using Send = std::function<void(const std::string& message)>;

    /// The size of the largest document that is served, in bytes; for a larger one, only its size is reported.
    static constexpr std::size_t most_document_bytes = std::size_t{4} << 20U;
    /// The largest size of all open documents together, in bytes.
    static constexpr std::size_t most_open_bytes = std::size_t{64} << 20U;

    /// True if messages arrived that receive() has not been given yet.
    using HasNews = std::function<bool()>;

    /// @param news  postpones measurements, so that errors are not reported late  @param stop  ends work early,
    /// beside the deadlines of the server
    explicit LanguageServer(Send send, HasNews news = {}, Monitor stop = {})
        : send_(std::move(send)), news_(std::move(news)), stop_(stop) {}

    /// Receives a message. work() answers it, unless a later message cancels it. A text that is not a message is
    /// refused at once. @throws what `send` throws
    void receive(const std::string& message);
    /// Reports a message that cannot be read. @param reason  a sentence
    void refuse(const std::string& reason);
    /// Answers the oldest waiting message, if there is one; errors in it are also sent as answers. @throws what
    /// `send` throws; Stopped
    void work();
    /// True while messages wait for work().
    bool has_work() const { return !waiting_.empty(); }
    /// Sends the errors of changed documents, if no further change waits. work() calls it before it answers a
    /// request; also call it when no message waits. @throws as work()
    void publish();

    /// True once the editor has sent `exit`.
    bool has_ended() const { return has_ended_; }
    /// 0 if the editor requested the shutdown before, otherwise 1.
    int exit_status() const { return is_shut_down_ ? 0 : 1; }

private:
    struct OpenDocument {
        std::string name;      ///< path of the file, for messages and for files that the pattern names
        std::string text;      ///< empty if it is too large
        std::size_t size = 0;  ///< bytes
        bool is_changed = true;
        bool is_served() const { return size == text.size(); }
    };
    struct View;  // an open document as it is read for a request

    using Answer = Json (LanguageServer::*)(const Json& parameters);
    struct Method;
    static const Method* find_method(std::string_view name);

    void cancel(const Json& id);
    Json answer(const std::string& method, const Json& parameters);
    void notice(const std::string& method, const Json& parameters);
    void reply(const Json& id, const char* member, Json value);
    void notify(const char* method, Json parameters);
    void put(const Json& document, const std::string& text);
    void change(const Json& document, const Json& changes);
    Json diagnostics_of(const OpenDocument& document) const;
    const OpenDocument& document_of(const Json& parameters) const;

    Json initialize(const Json& parameters);
    Json shutdown(const Json& parameters);
    Json hover(const Json& parameters);
    Json completion(const Json& parameters);
    Json definition(const Json& parameters);
    Json prepare_rename(const Json& parameters);
    Json rename(const Json& parameters);
    Json format(const Json& parameters);
    Json colours(const Json& parameters);
    Json colour_texts(const Json& parameters);
    Json lenses(const Json& parameters);
    Json tokens(const Json& parameters);

    Send send_;
    HasNews news_;
    Monitor stop_;
    std::deque<Json> waiting_;                       // messages, the oldest first
    std::map<std::string, OpenDocument> documents_;  // by address
    std::size_t open_bytes_ = 0;
    bool is_initialized_ = false;
    bool is_shut_down_ = false;
    bool has_ended_ = false;
};

}  // namespace sikku
