// tests/program/fake_sequencer.cpp: ALSA's sequencer without a kernel: replaces functions of the library in the
// program (LD_PRELOAD). Two ports exist; events are printed to standard error with their times by the queue, in
// microseconds. SIKKU_FAKE_EXIT: the port vanishes after so many events. SIKKU_FAKE_QUEUES=0: there is no queue.
#include <alsa/asoundlib.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>

namespace {

int wake = -1;
int sent = 0;
constexpr int queue = 5;
constexpr long long second = 1'000'000'000;
long long begun = -1;  // when the queue was started, in nanoseconds
long long last = 0;    // time of the last event
snd_seq_real_time_t real_time;

long long now() {
    timespec time{};
    clock_gettime(CLOCK_MONOTONIC, &time);
    return time.tv_sec * second + time.tv_nsec;
}

/// Prints an event and errors in its time.
void print(const char* kind, int first, int other, const snd_seq_event_t& event) {
    std::fprintf(stderr, "%s %d %d", kind, first, other);
    if (event.queue == SND_SEQ_QUEUE_DIRECT) {
        std::fprintf(stderr, " now\n");
        return;
    }
    const long long time = event.time.time.tv_sec * second + event.time.time.tv_nsec;
    std::fprintf(stderr, " at %lld\n", time / 1000);
    const int flags = event.flags & (SND_SEQ_TIME_STAMP_MASK | SND_SEQ_TIME_MODE_MASK);
    if (event.queue != queue || flags != (SND_SEQ_TIME_STAMP_REAL | SND_SEQ_TIME_MODE_ABS)) {
        std::fprintf(stderr, "wrong queue\n");
    }
    if (time < last) std::fprintf(stderr, "wrong order\n");
    last = time;
}

bool has_exit = false;
bool is_gone = false;
snd_seq_event_t exit_event;

}  // namespace

extern "C" {

int snd_seq_open(snd_seq_t** handle, const char*, int, int) {
    wake = eventfd(0, EFD_NONBLOCK);
    *handle = reinterpret_cast<snd_seq_t*>(&wake);
    return 0;
}

int snd_seq_alloc_named_queue(snd_seq_t*, const char*) {
    const char* queues = std::getenv("SIKKU_FAKE_QUEUES");
    return queues && std::atoi(queues) == 0 ? -EBUSY : queue;
}

int snd_seq_free_queue(snd_seq_t*, int number) {
    if (number != queue) std::fprintf(stderr, "wrong queue\n");
    if (begun >= 0 && !is_gone && now() - begun < last) std::fprintf(stderr, "wrong end: events are pending\n");
    return 0;
}

int snd_seq_control_queue(snd_seq_t*, int, int type, int, snd_seq_event_t*) {
    if (type == SND_SEQ_EVENT_START) begun = now();
    return 0;
}

int snd_seq_drain_output(snd_seq_t*) {
    return 0;
}

int snd_seq_get_queue_status(snd_seq_t*, int, snd_seq_queue_status_t*) {
    const long long time = now() - begun;
    real_time.tv_sec = static_cast<unsigned>(time / second);
    real_time.tv_nsec = static_cast<unsigned>(time % second);
    return 0;
}

const snd_seq_real_time_t* snd_seq_queue_status_get_real_time(const snd_seq_queue_status_t*) {
    return &real_time;
}

int snd_seq_set_client_pool_output(snd_seq_t*, size_t) {
    return 0;
}

int snd_seq_close(snd_seq_t*) {
    return close(wake);
}

int snd_seq_set_client_name(snd_seq_t*, const char*) {
    return 0;
}

int snd_seq_client_id(snd_seq_t*) {
    return 129;
}

int snd_seq_query_next_client(snd_seq_t*, snd_seq_client_info_t* info) {
    const int last = snd_seq_client_info_get_client(info);
    if (last >= 128) return -ENOENT;
    snd_seq_client_info_set_client(info, last < 0 ? 0 : last < 14 ? 14 : 128);
    snd_seq_client_info_set_name(info, last < 0 ? "System" : last < 14 ? "Midi Through" : "FLUID Synth (1)");
    return 0;
}

int snd_seq_query_next_port(snd_seq_t*, snd_seq_port_info_t* info) {
    // -1, which asks for the first port, is stored in a byte.
    if (snd_seq_port_info_get_port(info) != 255) return -ENOENT;
    const bool is_synthesizer = snd_seq_port_info_get_client(info) == 128;
    snd_seq_port_info_set_port(info, 0);
    snd_seq_port_info_set_name(info, is_synthesizer ? "Synth input port" : "Midi Through Port-0");
    const unsigned in = SND_SEQ_PORT_CAP_WRITE | SND_SEQ_PORT_CAP_SUBS_WRITE;
    const unsigned out = SND_SEQ_PORT_CAP_READ | SND_SEQ_PORT_CAP_SUBS_READ;
    snd_seq_port_info_set_capability(info, is_synthesizer ? in : in | out);
    return 0;
}

int snd_seq_create_simple_port(snd_seq_t*, const char*, unsigned, unsigned) {
    return 3;
}

int snd_seq_connect_to(snd_seq_t*, int port, int client, int other) {
    std::fprintf(stderr, "connect %d to %d:%d\n", port, client, other);
    return 0;
}

int snd_seq_connect_from(snd_seq_t*, int port, int client, int other) {
    std::fprintf(stderr, "connect %d from %d:%d\n", port, client, other);
    return 0;
}

int snd_seq_event_output_direct(snd_seq_t*, snd_seq_event_t* event) {
    const auto& note = event->data.note;
    const auto& control = event->data.control;
    if (event->source.port != 3) std::fprintf(stderr, "wrong address\n");
    if (event->type == SND_SEQ_EVENT_NOTEON) print("on", note.channel, note.note, *event);
    if (event->type == SND_SEQ_EVENT_NOTEOFF) print("off", note.channel, note.note, *event);
    if (event->type == SND_SEQ_EVENT_PGMCHANGE) print("program", control.channel, control.value, *event);
    if (event->type == SND_SEQ_EVENT_PITCHBEND) print("bend", control.channel, control.value, *event);
    if (event->type == SND_SEQ_EVENT_SYSEX) print("sysex", 0, static_cast<int>(event->data.ext.len), *event);
    if (event->type == SND_SEQ_EVENT_CLOCK) print("clock", 0, 0, *event);
    const char* limit = std::getenv("SIKKU_FAKE_EXIT");
    if (limit && ++sent == std::atoi(limit)) {
        snd_seq_ev_clear(&exit_event);
        exit_event.type = SND_SEQ_EVENT_CLIENT_EXIT;
        exit_event.data.addr.client = 128;
        has_exit = is_gone = true;
        eventfd_write(wake, 1);
    }
    return 0;
}

int snd_seq_event_input_pending(snd_seq_t*, int) {
    return 0;
}

int snd_seq_event_input(snd_seq_t*, snd_seq_event_t** event) {
    std::uint64_t count = 0;
    if (!has_exit || eventfd_read(wake, &count) != 0) return -EAGAIN;
    has_exit = false;
    *event = &exit_event;
    return 0;
}

int snd_seq_poll_descriptors(snd_seq_t*, pollfd* descriptors, unsigned, short events) {
    descriptors[0].fd = wake;
    descriptors[0].events = events;
    return 1;
}

}  // extern "C"
