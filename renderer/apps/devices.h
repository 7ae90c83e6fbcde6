#pragma once

namespace halfsilver {

// Prints all devices: what they are, what they offer of each limit and what of it is needed, or why they are refused.
// Throws Error (noContext) if none can be used.
void showDevices(bool json);

}  // namespace halfsilver
