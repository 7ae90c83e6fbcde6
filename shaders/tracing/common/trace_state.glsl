// What a dispatch may leave to the next one.
//
// Some drivers stop all loops of a shader, silently, after a number of iterations (65,535 on Mesa's llvmpipe, summed
// over the rays that run in one vector). So a ray that has done `workLimit` of them leaves the rest to the next
// dispatch (`resuming`); every search notices when the driver stopped it, and the ray then goes on from the last voxel
// that it had done. What the last dispatch leaves is given up, counted and marked, like a ray that came by
// a texel with lost fragments.
uniform int workLimit;
uniform int resuming;
uniform int lastDispatch;
bool cut = false;  // the driver stopped a loop of the attribute search
bool incomplete = false;  // the ray came by something that is missing from the structure
