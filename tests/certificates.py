"""Certificate authority for tests, and a certificate that it signs for this machine."""

import shutil
import subprocess

import pytest

from tftool.world.link.zenoh.reach import Certificates

needs_openssl = pytest.mark.skipif(
    shutil.which("openssl") is None, reason="needs openssl to make certificates"
)


def certificates(folder):
    """Create the certificates in a folder, with the authority's key in ca.key."""

    def openssl(*words):
        subprocess.run(["openssl", *words], check=True, capture_output=True, cwd=folder)

    for name in ("ca", "own"):
        openssl("ecparam", "-name", "prime256v1", "-genkey", "-noout", "-out", f"{name}.key")
    (folder / "own.ext").write_text("subjectAltName=DNS:localhost,IP:127.0.0.1\n")
    openssl("req", "-x509", "-key", "ca.key", "-subj", "/CN=test", "-days", "2", "-out", "ca.pem")
    openssl("req", "-new", "-key", "own.key", "-subj", "/CN=localhost", "-out", "own.csr")
    openssl(
        *("x509", "-req", "-in", "own.csr", "-CA", "ca.pem", "-CAkey", "ca.key"),
        *("-CAcreateserial", "-days", "2", "-extfile", "own.ext", "-out", "own.pem"),
    )
    return Certificates(folder / "own.pem", folder / "own.key", folder / "ca.pem")
