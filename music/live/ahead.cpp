#include "music/live/ahead.h"

#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace sikku::live {
namespace {

constexpr std::size_t windows_ahead = 2;

class AheadStream final : public NoteStream {
public:
    AheadStream(const OpenStream& open, const Monitor& outer)
        : outer_(outer), stream_(open(monitor())), thread_([this] { read(); }) {}
    AheadStream(const AheadStream&) = delete;
    AheadStream& operator=(const AheadStream&) = delete;
    ~AheadStream() override {
        {
            const std::lock_guard lock(mutex_);
            is_over_ = true;
            stops_reading_ = true;
        }
        wanted_.notify_one();
        thread_.join();
    }

    const ScoreHead& head() const override { return stream_->head(); }
    const MidiOptions& midi() const override { return stream_->midi(); }

    void seek(std::int64_t tick) override {
        {
            const std::lock_guard lock(mutex_);
            sought_ = tick;
            windows_.clear();
            error_ = nullptr;
            stops_reading_ = is_reading_;
        }
        wanted_.notify_one();
    }

    bool is_ready() override {
        const std::lock_guard lock(mutex_);
        return error_ || !windows_.empty();
    }

    NoteWindow next() override {
        std::unique_lock lock(mutex_);
        read_.wait(lock, [this] { return error_ || !windows_.empty(); });
        if (windows_.empty()) std::rethrow_exception(error_);
        NoteWindow window = std::move(windows_.front());
        windows_.pop_front();
        lock.unlock();
        wanted_.notify_one();
        return window;
    }

private:
    Monitor monitor() {
        const auto stops = [](void* context) {
            const auto* self = static_cast<AheadStream*>(context);
            return self->stops_reading_ || self->outer_.stop_requested();
        };
        return Monitor(stops, nullptr, this);
    }

    void read() {
        std::unique_lock lock(mutex_);
        for (;;) {
            wanted_.wait(lock,
                         [this] { return is_over_ || sought_ || (!error_ && windows_.size() < windows_ahead); });
            if (is_over_) return;
            if (sought_) stream_->seek(*std::exchange(sought_, std::nullopt));
            is_reading_ = true;
            stops_reading_ = false;
            lock.unlock();
            NoteWindow window;
            std::exception_ptr error;
            try {
                window = stream_->next();
            } catch (...) {
                error = std::current_exception();
            }
            lock.lock();
            is_reading_ = false;
            if (is_over_) return;
            if (sought_) continue;  // seek() was called meanwhile: these notes are not needed
            if (error) {
                error_ = error;
            } else {
                windows_.push_back(std::move(window));
            }
            read_.notify_one();
        }
    }

    Monitor outer_;
    std::mutex mutex_;
    std::condition_variable wanted_;  // the thread has work
    std::condition_variable read_;
    std::atomic<bool> stops_reading_{false};
    bool is_over_ = false;
    bool is_reading_ = false;
    std::optional<std::int64_t> sought_;
    std::deque<NoteWindow> windows_;
    std::exception_ptr error_;
    std::unique_ptr<NoteStream> stream_;
    std::thread thread_;  // last: it uses the others
};

}  // namespace

std::unique_ptr<NoteStream> read_ahead(const OpenStream& open, const Monitor& outer) {
    return std::make_unique<AheadStream>(open, outer);
}

}  // namespace sikku::live
