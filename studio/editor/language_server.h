// studio/editor/language_server.h: a server of the language server protocol: messages in, messages out.
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

/// Serves documents that an editor has open: errors while they are written, help, completion, definitions, renaming,
/// formatting, colours, and the sizes of what they draw. Not thread-safe. Memory: that of the documents.
class LanguageServer {
public:
    /// Takes a message: JSON, without its header.
    using Send = std::function<void(const std::string& message)>;

    /// The largest document that is served; of a larger one only its size is reported.
    static constexpr std::size_t most_document_bytes = std::size_t{4} << 20U;
    /// All open documents together.
    static constexpr std::size_t most_open_bytes = std::size_t{64} << 20U;

    /// True if messages arrived that receive() has not been given yet.
    using HasNews = std::function<bool()>;

    /// @param news  postpones measurements, so that errors are not reported late  @param stop  ends work early,
    /// beside the deadlines of the server
    explicit LanguageServer(Send send, HasNews news = {}, Monitor stop = {})
        : send_(std::move(send)), news_(std::move(news)), stop_(stop) {}

    /// Takes a message, which work() answers, unless a later one cancels it. What is not a message is refused at
    /// once. @throws what `send` throws
    void receive(const std::string& message);
    /// Answers a message that could not be read. @param reason  a sentence
    void refuse(const std::string& reason);
    /// Answers the oldest message that waits, if there is one; errors in it are answers, too. @throws what `send`
    /// throws; Stopped
    void work();
    /// True while messages wait for work().
    bool has_work() const { return !waiting_.empty(); }
    /// Sends the errors of documents that changed, if no further change waits. work() does so before it answers a
    /// request; call it, too, when nothing waits. @throws as work()
    void publish();

    /// True once the editor has sent `exit`.
    bool has_ended() const { return has_ended_; }
    /// 0 if the editor asked for the shutdown before, else 1.
    int exit_status() const { return is_shut_down_ ? 0 : 1; }

private:
    struct OpenDocument {
        std::string name;      ///< path of the file, for messages and for files that the pattern names
        std::string text;      ///< empty if it is too large
        std::size_t size = 0;  ///< bytes
        bool is_changed = true;
        bool is_served() const { return size == text.size(); }
    };
    struct View;  // an open document, read

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
