// Numbers with as many digits as the page's tables have.

// As digits_text() of results/number_text.h.
export function in_digits(value: number, digits: number): string {
  if (value === 0) return '0';
  if (Math.abs(value) < 1e-4) return value.toExponential(0);
  // 9.996 is 10.0 and not 10.00.
  const rounded = Math.abs(Number(value.toPrecision(digits)));
  return value.toFixed(Math.max(0, Math.min(9, digits - 1 - Math.floor(Math.log10(rounded)))));
}

// "47,311", as counts of pixels are in the page's text.
export const grouped = (count: number) => count.toLocaleString('en');

// "2.00 %".
export const percent_text = (share: number) => `${in_digits(100 * share, 3)} %`;
