/* Reference encoder of the dualfoot_ros frame; see docs/reference/mcu_frame.md.  C99 and Arduino. */
#ifndef DUALFOOT_FRAME_H
#define DUALFOOT_FRAME_H

#include <stddef.h>
#include <stdint.h>

#define DUALFOOT_FRAME_MAX 43 /* bytes, terminating zero included */

#ifdef __cplusplus
extern "C" {
#endif

/* What force and rate are; zero does not say. */
#define DUALFOOT_AVERAGED 1    /* means over the interval, as of a FIFO that was summed */
#define DUALFOOT_SAMPLED 2     /* values at the instant */
#define DUALFOOT_COMPENSATED 3 /* held, they give increments compensated for coning and sculling */

/* Temperature and magnetic field that may go along; NULL in place of either leaves it out. */
typedef struct {
    const int16_t *centidegrees; /* 1 value, 0.01 degrees Celsius */
    const int16_t *field;        /* 3 values, 0.1 microtesla */
    uint8_t increments;          /* one of the above, or zero */
} dualfoot_extras;

/* Both fill `out` (DUALFOOT_FRAME_MAX bytes) and return how many bytes to send.  `extras` may be
   NULL.  Axes and signs are the sensor's own; the receiver turns them. */

/* Specific force in m/s^2 and angular rate in rad/s. */
size_t dualfoot_frame_f32(uint8_t *out, uint16_t counter, uint32_t micros, const float force[3],
                          const float rate[3], const dualfoot_extras *extras);

/* The sensor's own whole numbers, and what one of them is worth in m/s^2 and in rad/s. */
size_t dualfoot_frame_i16(uint8_t *out, uint16_t counter, uint32_t micros, float force_scale,
                          float rate_scale, const int16_t force[3], const int16_t rate[3],
                          const dualfoot_extras *extras);

#ifdef __cplusplus
}
#endif
#endif
