// Bindings of pictures on their way to the display: passes/display.frag, passes/fxaa.frag.
#ifndef HALFSILVER_PASSES_DISPLAY_H
#define HALFSILVER_PASSES_DISPLAY_H

#define UNIT_PICTURE 0

#endif
