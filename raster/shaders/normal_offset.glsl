// What a normal offset is multiplied by: OffsetProfile of techniques/shadow/normal_offset.h. The angle is between the
// normal and the direction to the light.
double offset_scale(int profile, double sine, double cosine) {
  return profile == OFFSET_SINE ? sine : profile == OFFSET_CONSTANT ? 1.0lf : 1.0lf - max(cosine, 0.0lf);
}
