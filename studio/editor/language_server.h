// studio/editor/language_server.h: a language server that receives and sends messages.
// Source: Microsoft, Language Server Protocol 3.17; JSON-RPC 2.0.
#pragma once

#include "engine/base/monitor.h"
#include "studio/editor/open_documents.h"
#include "studio/editor/request_members.h"

#include <deque>
#include <functional>
#include <string>
#include <utility>

namespace sikku {

/// Serves the open documents of an editor: errors while the user types, help, completion, definitions, renaming,
/// formatting, colours, and the sizes of drawings. Not thread-safe. Memory: that of the documents.
class LanguageServer {
public:
    /// Receives an outgoing message: JSON, without its header.
    using Send = std::function<void(const std::string& message)>;

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
    void cancel(const Json& id);
    Json answer(const std::string& method, const Json& parameters);
    Json initialize();
    void notice(const std::string& method, const Json& parameters);
    void reply(const Json& id, const char* member, Json value);
    void notify(const char* method, Json parameters);
    Json diagnostics_of(const OpenDocument& document) const;

    Send send_;
    HasNews news_;
    Monitor stop_;
    std::deque<Json> waiting_;  // messages, the oldest first
    OpenDocuments documents_;
    bool is_initialized_ = false;
    bool is_shut_down_ = false;
    bool has_ended_ = false;
};

}  // namespace sikku
