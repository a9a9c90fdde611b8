// Leaves the depth to the rasteriser.
void main() {}
