// What a normal offset is multiplied by: OffsetProfile of techniques/shadow/normal_offset.h. The angle is between the
// normal and the direction to the light.
double offset_scale(int profile, double sine, double cosine) {
  if (profile == OFFSET_SINE) return sine;
  if (profile == OFFSET_CONSTANT) return 1.0lf;
  return profile == OFFSET_EEVEE ? sine + 0.16785171781851177lf : 1.0lf - max(cosine, 0.0lf);
}
