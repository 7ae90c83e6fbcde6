// Bindings of the methods that look at the screen: tracing/screen/ and tracing/screen_first/.
#ifndef HALFSILVER_PASSES_SCREEN_H
#define HALFSILVER_PASSES_SCREEN_H

#define UNIT_SCREEN_DEPTHS 8  // sampler2D; a trace reads no shadow maps
#define UNIT_BACK_DEPTHS 9    // sampler2D; a pyramid reads no sky
#define IMAGE_SCREEN_DEPTHS 0

#define SCREEN_LEVELS 6  // of the pyramid; the largest cell is 32 pixels wide

// Rays that the screen does not answer.
#define SSBO_REST_RAYS 11     // uvec4[], as SSBO_RAYS
#define SSBO_REST_COUNT 12    // RayCount
#define SSBO_REST_INDICES 13  // uint[]: their places in the queue
#define SSBO_REST_HITS 14     // Hit[]
#define SSBO_ANSWERS 15       // uint[] by ray of the queue: ANSWER_...

// Who has answered a ray. RayCount::byKind counts both as if they were kinds of rays.
#define ANSWER_FIRST 1u
#define ANSWER_STRUCTURE 2u
#define COUNT_ANSWERED_FIRST 6
#define COUNT_ANSWERED_BY_STRUCTURE 7

#endif
