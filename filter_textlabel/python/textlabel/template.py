"""Names made of fields: '{part}-{n:04}' with part=bracket and n=7 is 'bracket-0007'."""

import re
import string


class TemplateError(ValueError):
    """A template that cannot be used; the text says why."""


class Template:
    """Fields are plain names in braces, with a format after a colon if wanted."""

    def __init__(self, text):
        """Raises TemplateError when the braces do not match or a field is no plain name."""
        self.text = text
        try:
            self.fields = [field for _, field, _, _ in string.Formatter().parse(text) if field is not None]
        except ValueError as error:
            raise TemplateError(f"The template '{text}' cannot be read: {error}. Write {{{{ and }}}} for braces themselves.") from None
        for field in self.fields:
            if not re.fullmatch(r"\w[\w -]*", field):
                raise TemplateError(f"The template '{text}' holds {{{field}}}. Write a field's name in braces.")

    def check(self, names):
        """Raise TemplateError when a field is none of names."""
        for field in self.fields:
            if field not in names:
                raise TemplateError(
                    f"The template '{self.text}' wants {{{field}}}. There are: {', '.join(sorted(names))}."
                )

    def fill(self, values):
        """The text with its fields filled in. Raises TemplateError when a format does not fit the value."""
        cells = {name: _Cell(value) if isinstance(value, str) else value for name, value in values.items()}
        try:
            return string.Formatter().vformat(self.text, (), cells)
        except (ValueError, TypeError, AttributeError, KeyError, IndexError) as error:
            raise TemplateError(f"The template '{self.text}' cannot be filled in: {error}.") from None


class _Cell(str):
    """A cell of a table. A format for numbers takes it as a number, so that 7 in {order:04} is 0007, not 7000."""

    def __format__(self, form):
        return format(int(self), form) if re.fullmatch(r"0\d+d?|\d*d", form) else super().__format__(form)


def file_part(value):
    """A text as part of a file name: what file systems or shells take amiss becomes _."""
    return re.sub(r'[\x00-\x1f\x7f/\\:*?"<>|\s]+', "_", value).strip(".") or "_"
