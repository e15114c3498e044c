#include "engine/derivation/word_stream.h"

#include "engine/base/monitor.h"

#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

namespace sikku {
namespace {

constexpr std::size_t piece_size = std::size_t{1} << 16;

}  // namespace

/// State shared by the reader and the thread.
struct WordStream::State : public SymbolSink {
    std::shared_ptr<const Grammar> grammar;
    DerivationOptions options;

    std::mutex mutex;
    std::condition_variable changed;
    WordPiece handed;  ///< for the reader, if `is_ready`
    bool is_ready = false;
    bool is_finished = false;  ///< the thread has handed over its last piece
    std::exception_ptr error;
    std::atomic<bool> is_stopped{false};

    WordPiece own;  ///< being filled by the thread
    std::mutex joining;
    std::thread thread;

    void symbols(const Run& run) override {
        own.symbols.insert(own.symbols.end(), run.symbols.begin(), run.symbols.end());
        own.arguments.insert(own.arguments.end(), run.arguments.begin(), run.arguments.end());
        if (own.symbols.size() >= piece_size) hand_over();
    }

    void hand_over() {
        std::unique_lock lock(mutex);
        changed.wait(lock, [this] { return !is_ready || is_stopped; });
        if (is_stopped) throw Stopped();
        std::swap(own, handed);
        is_ready = true;
        changed.notify_all();
        own.symbols.clear();
        own.arguments.clear();
    }

    void run() noexcept {
        try {
            derive(*grammar, *this, options);
            if (!own.symbols.empty()) hand_over();
        } catch (const Stopped&) {  // the reader has closed the stream
        } catch (...) {
            error = std::current_exception();
        }
        const std::lock_guard lock(mutex);
        is_finished = true;
        changed.notify_all();
    }
};

WordStream::WordStream(std::shared_ptr<const Grammar> grammar, DerivationOptions options)
    : state_(std::make_unique<State>()) {
    state_->grammar = std::move(grammar);
    state_->options = std::move(options);
    state_->options.pruner = nullptr;
    state_->options.watch = [state = state_.get(), watch = state_->options.watch](std::uint64_t symbols) {
        if (state->is_stopped) throw Stopped();
        if (watch) watch(symbols);
    };
    state_->thread = std::thread([state = state_.get()] { state->run(); });
}

WordStream::~WordStream() {
    stop();
}

void WordStream::stop() {
    {
        const std::lock_guard lock(state_->mutex);
        state_->is_stopped = true;
        state_->changed.notify_all();
    }
    const std::lock_guard lock(state_->joining);
    if (state_->thread.joinable()) state_->thread.join();
}

WordStream::Next WordStream::next(WordPiece& piece, std::chrono::milliseconds patience) {
    std::unique_lock lock(state_->mutex);
    const bool is_there = state_->changed.wait_for(
        lock, patience, [this] { return state_->is_ready || state_->is_finished || state_->is_stopped; });
    if (state_->is_stopped) return Next::end;
    if (state_->is_ready) {
        std::swap(piece, state_->handed);
        state_->is_ready = false;
        state_->changed.notify_all();
        return Next::piece;
    }
    if (!is_there) return Next::waiting;
    if (const std::exception_ptr error = std::exchange(state_->error, nullptr)) std::rethrow_exception(error);
    return Next::end;
}

}  // namespace sikku
