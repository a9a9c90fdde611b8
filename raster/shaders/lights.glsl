// The list of lights.
layout(std430) restrict readonly buffer Lights { LightSource lights[]; };
