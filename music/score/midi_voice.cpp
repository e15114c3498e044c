#include "music/score/midi_voice.h"

namespace sikku::midi {
namespace {

/// The order of events of one tick in the file.
int rank(unsigned char status) {
    switch (status & 0xF0) {
        case 0xB0:
            return 1;
        case 0xC0:
            return 2;
        case 0x80:
            return 3;
        case 0xE0:
            return 4;
        case 0x90:
            return 5;
        default:
            return status == 0xF0 ? 4 : 0;
    }
}

}  // namespace

Events::Events(const Voice& voice, std::string_view opening) {
    pieces_.push_back(opening);
    pieces_.insert(pieces_.end(), voice.full.begin(), voice.full.end());
    pieces_.push_back(voice.open_block());
    next();
}

std::int64_t Events::place() const {
    return tick_ * 8 + rank(static_cast<unsigned char>(event_.front()));
}

void Events::next() {
    event_ = {};
    while (rest_.empty()) {
        if (piece_ == pieces_.size()) return;
        rest_ = pieces_[piece_++];
    }
    tick_ += static_cast<std::int64_t>(number());
    const auto first = static_cast<unsigned char>(rest_.front());
    std::size_t size = (first & 0xF0) == 0xC0 ? 2 : 3;
    if (first >= 0xF0) {
        const std::string_view whole = rest_;
        rest_.remove_prefix(first == 0xFF ? 2 : 1);
        const auto data = static_cast<std::size_t>(number());
        size = whole.size() - rest_.size() + data;
        rest_ = whole;
    }
    event_ = rest_.substr(0, size);
    rest_.remove_prefix(size);
}

std::uint64_t Events::number() {
    std::uint64_t value = 0;
    for (;;) {
        const auto byte = static_cast<unsigned char>(rest_.front());
        rest_.remove_prefix(1);
        value = value << 7 | (byte & 0x7F);
        if (byte < 0x80) return value;
    }
}

}  // namespace sikku::midi
