"""Payloads that a hostile sender may create."""


def mutations(chance, payload):
    raw = bytearray(payload)
    for _ in range(chance.randrange(1, 4)):
        what = chance.randrange(4)
        place = chance.randrange(len(raw)) if raw else 0
        if what == 0 and raw:
            raw[place] = chance.randrange(256)
        elif what == 1:
            del raw[place:]
        elif what == 2:
            raw[place:place] = chance.randbytes(chance.randrange(1, 12))
        elif len(raw) >= 4:
            place &= ~3
            raw[place : place + 4] = chance.choice(
                [b"\xff\xff\xff\xff", b"\x00\x00\x00\x80", b"\xff\xff\xff\x7f", b"\x00\x00\x00\x00"]
            )
    return bytes(raw)
