// tests/program/fake_sequencer.cpp: ALSA's sequencer without a kernel: replaces functions of the library in the
// program (LD_PRELOAD). Two ports exist; events are printed to standard error. SIKKU_FAKE_EXIT: the port vanishes
// after so many events.
#include <alsa/asoundlib.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace {

int wake = -1;
int sent = 0;
bool has_exit = false;
snd_seq_event_t exit_event;

}  // namespace

extern "C" {

int snd_seq_open(snd_seq_t** handle, const char*, int, int) {
    wake = eventfd(0, EFD_NONBLOCK);
    *handle = reinterpret_cast<snd_seq_t*>(&wake);
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
    if (event->source.port != 3 || event->queue != SND_SEQ_QUEUE_DIRECT) std::fprintf(stderr, "wrong address\n");
    if (event->type == SND_SEQ_EVENT_NOTEON) std::fprintf(stderr, "on %d %d\n", note.channel, note.note);
    if (event->type == SND_SEQ_EVENT_NOTEOFF) std::fprintf(stderr, "off %d %d\n", note.channel, note.note);
    if (event->type == SND_SEQ_EVENT_PGMCHANGE) std::fprintf(stderr, "program %d\n", event->data.control.value);
    if (event->type == SND_SEQ_EVENT_PITCHBEND) std::fprintf(stderr, "bend %d\n", event->data.control.value);
    if (event->type == SND_SEQ_EVENT_SYSEX) std::fprintf(stderr, "sysex %u\n", event->data.ext.len);
    const char* limit = std::getenv("SIKKU_FAKE_EXIT");
    if (limit && ++sent == std::atoi(limit)) {
        snd_seq_ev_clear(&exit_event);
        exit_event.type = SND_SEQ_EVENT_CLIENT_EXIT;
        exit_event.data.addr.client = 128;
        has_exit = true;
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
