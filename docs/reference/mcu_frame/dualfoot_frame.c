/* Reference encoder of the dualfoot_ros frame; see docs/reference/mcu_frame.md.  C99 and Arduino. */
#include "dualfoot_frame.h"

#include <string.h>

static uint8_t *put(uint8_t *at, uint32_t value, int bytes) { /* little-endian on any machine */
    while (bytes-- > 0) {
        *at++ = (uint8_t)value;
        value >>= 8;
    }
    return at;
}

static uint8_t *put_f32(uint8_t *at, float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return put(at, bits, 4);
}

static uint16_t crc16(const uint8_t *data, size_t size) { /* CRC-16/CCITT-FALSE */
    uint16_t crc = 0xFFFF;
    while (size-- > 0) {
        crc ^= (uint16_t)((uint16_t)*data++ << 8);
        for (int bit = 0; bit < 8; bit++)
            crc = (uint16_t)((uint32_t)crc << 1 ^ (crc & 0x8000u ? 0x1021u : 0u));
    }
    return crc;
}

static uint8_t *begin(uint8_t *plain, uint8_t layout, uint16_t counter, uint32_t micros,
                      const dualfoot_extras *extras) {
    if (extras && extras->centidegrees) layout |= 0x10;
    if (extras && extras->field) layout |= 0x20;
    if (extras) layout = (uint8_t)(layout | (extras->increments & 3u) << 6);
    return put(put(put(plain, layout, 1), counter, 2), micros, 4);
}

/* Append extras and checksum, then stuff into `out`; messages below 254 bytes have one code
   byte more than they have content, and the terminating zero. */
static size_t finish(uint8_t *out, uint8_t *plain, uint8_t *at, const dualfoot_extras *extras) {
    if (extras && extras->centidegrees) at = put(at, (uint16_t)*extras->centidegrees, 2);
    for (int k = 0; extras && extras->field && k < 3; k++)
        at = put(at, (uint16_t)extras->field[k], 2);
    at = put(at, crc16(plain, (size_t)(at - plain)), 2);
    uint8_t *code = out++, *start = code;
    for (const uint8_t *from = plain; from < at; from++) {
        if (*from) {
            *out++ = *from;
        } else {
            *code = (uint8_t)(out - code);
            code = out++;
        }
    }
    *code = (uint8_t)(out - code);
    *out++ = 0;
    return (size_t)(out - start);
}

size_t dualfoot_frame_f32(uint8_t *out, uint16_t counter, uint32_t micros, const float force[3],
                          const float rate[3], const dualfoot_extras *extras) {
    uint8_t plain[DUALFOOT_FRAME_MAX], *at = begin(plain, 1, counter, micros, extras);
    for (int k = 0; k < 6; k++) at = put_f32(at, k < 3 ? force[k] : rate[k - 3]);
    return finish(out, plain, at, extras);
}

size_t dualfoot_frame_i16(uint8_t *out, uint16_t counter, uint32_t micros, float force_scale,
                          float rate_scale, const int16_t force[3], const int16_t rate[3],
                          const dualfoot_extras *extras) {
    uint8_t plain[DUALFOOT_FRAME_MAX], *at = begin(plain, 2, counter, micros, extras);
    at = put_f32(put_f32(at, force_scale), rate_scale);
    for (int k = 0; k < 6; k++) at = put(at, (uint16_t)(k < 3 ? force[k] : rate[k - 3]), 2);
    return finish(out, plain, at, extras);
}
